// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/cells/cell_size.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vtkCell.h>
#include <vtkGenericCell.h>
#include <vtkSmartPointer.h>

#include "catch.h"

using trismooth::cell_size_of;
using Types = std::vector<std::uint8_t>;

TEST_CASE("cells of a fixed number of vertices have as many as VTK's classes") {
  for (const std::uint8_t type : Types{1,  3,  5,  8,  9,  10, 11, 12, 13, 14, 15, 16, 21, 22,
                                       23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 37}) {
    CAPTURE(static_cast<int>(type));
    const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
    REQUIRE(cell != nullptr);
    const auto vertices = static_cast<std::size_t>(cell->GetNumberOfPoints());
    CHECK(cell_size_of(type).allows(vertices));
    CHECK_FALSE(cell_size_of(type).allows(vertices - 1));
    CHECK_FALSE(cell_size_of(type).allows(vertices + 1));
  }
}

TEST_CASE("cells of any number of vertices, and of types that are not known, may have many") {
  for (const std::uint8_t type : Types{2, 4, 6, 7, 36, 41, 42, 68, 69, 70, 71, 72, 73, 74, 255}) {
    CAPTURE(static_cast<int>(type));
    CHECK(cell_size_of(type).allows(3));
    CHECK(cell_size_of(type).allows(1000));
  }
}

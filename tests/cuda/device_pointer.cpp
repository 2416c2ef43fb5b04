// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

#include "trismooth/cuda/device_mesh.h"

#include "catch.h"

using trismooth::cuda::DeviceMesh;
using trismooth::cuda::Plan;

namespace {

template <class T>
T* at(std::size_t address) {
  return reinterpret_cast<T*>(address);  // NOLINT(performance-no-int-to-ptr): nobody looks there
}

std::string refusal(const std::function<void()>& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("pointers that are null or out of alignment are refused by name, without asking for a device") {
  const DeviceMesh mesh{5, 4, at<const std::int32_t>(4096), {}};
  for (const std::size_t offset : {1U, 2U, 4U, 8U}) {
    CHECK(refusal([&] { trismooth::cuda::smooth(mesh, at<double>(4096 + offset)); }) ==
          "xy is not aligned to 16 bytes, as it must be on a device");
    if (offset < 8) {
      CHECK(refusal([&] { trismooth::cuda::smooth(mesh, at<float>(4096 + offset)); }) ==
            "xy is not aligned to 8 bytes, as it must be on a device");
    }
  }
  CHECK(refusal([&] { trismooth::cuda::smooth(mesh, at<double>(0)); }) == "xy is a null pointer");
  CHECK(refusal([&] { trismooth::cuda::smooth(mesh, at<float>(0)); }) == "xy is a null pointer");

  const auto with = [&](const auto& change) {
    DeviceMesh changed = mesh;
    change(changed);
    return refusal([&] { Plan(changed, {}); });
  };
  CHECK(with([](DeviceMesh& m) { m.elements = at<const std::int32_t>(4097); }) ==
        "DeviceMesh::elements is not aligned to 4 bytes, as it must be on a device");
  CHECK(with([](DeviceMesh& m) { m.elements = nullptr; }) == "DeviceMesh::elements is a null pointer");
  CHECK(with([](DeviceMesh& m) {
          m.corners = 4;
          m.elements = nullptr;
        }) == "DeviceMesh::elements is a null pointer");
  for (const std::int32_t corners : {-3, 0, 2, 5}) {
    CHECK(with([corners](DeviceMesh& m) { m.corners = corners; }) ==
          "DeviceMesh::corners is " + std::to_string(corners) + "; expected 3, or 4 with quadrilaterals");
  }
  CHECK(with([](DeviceMesh& m) { m.constraints.regions = at<const std::int32_t>(4098); }) ==
        "DeviceConstraints::regions is not aligned to 4 bytes, as it must be on a device");
  CHECK(with([](DeviceMesh& m) { m.constraints.fixed_id_count = 2; }) ==
        "DeviceConstraints::fixed_ids is a null pointer");
  CHECK(with([](DeviceMesh& m) { m.constraints.fixed_id_count = -1; }) ==
        "DeviceConstraints::fixed_id_count is negative");
}

TEST_CASE("more elements than can be numbered are refused, of four numbers each sooner than of three") {
  DeviceMesh mesh{5, 536870912, at<const std::int32_t>(4096)};
  mesh.corners = 4;
  CHECK_THROWS_WITH(Plan(mesh, {}), "more than 536870911 elements");
  mesh.element_count = -1;
  CHECK_THROWS_WITH(Plan(mesh, {}), "the number of elements is negative");
  mesh.corners = 3;
  CHECK_THROWS_WITH(Plan(mesh, {}), "the number of triangles is negative");
  mesh.element_count = 715827883;
  CHECK_THROWS_WITH(Plan(mesh, {}), "more than 715827882 triangles");
}

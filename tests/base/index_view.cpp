// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/index_view.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "trismooth/base/errors.h"
#include "trismooth/smoothing/smooth.h"

#include "catch.h"
#include "support/refusal.h"
#include "support/test_meshes.h"

namespace trismooth::index_view_test {

using test_meshes::Mesh;
using test_support::refusal;

static_assert(std::is_convertible_v<const std::vector<std::int32_t>&, IndexView>);
// Temporaries that own their numbers are gone before anybody can look.
static_assert(!std::is_convertible_v<std::vector<std::size_t>, IndexView>);
static_assert(!std::is_convertible_v<const std::vector<std::int32_t>, IndexView>);
static_assert(!std::is_convertible_v<std::array<std::int32_t, 3>, IndexView>);
static_assert(!std::is_convertible_v<std::vector<Triangle>, IndexView>);
static_assert(!std::is_convertible_v<Eigen::Matrix3Xi, IndexView>);
static_assert(std::is_convertible_v<std::vector<std::size_t>&, IndexView>);
template <class Matrix>
concept TakenByRows = requires(Matrix&& matrix) {
  trismooth::triangle_rows(std::forward<Matrix>(matrix));
  trismooth::triangle_columns(std::forward<Matrix>(matrix));
};
static_assert(TakenByRows<Eigen::MatrixXi&> && TakenByRows<Eigen::Map<Eigen::MatrixXi>>);
static_assert(!TakenByRows<Eigen::MatrixXi>);
static_assert(std::is_convertible_v<std::span<const std::uint32_t>, IndexView>);
static_assert(std::is_convertible_v<std::vector<std::array<long long, 3>>&, IndexView>);
static_assert(std::is_convertible_v<const Eigen::Matrix3Xi&, IndexView>);
static_assert(!std::is_convertible_v<std::vector<double>&, IndexView>);
static_assert(!std::is_convertible_v<std::vector<std::uint8_t>&, IndexView>);
static_assert(std::is_convertible_v<std::vector<std::array<int, 4>>&, IndexView>);
static_assert(!std::is_convertible_v<std::vector<std::array<int, 5>>&, IndexView>);
static_assert(!std::is_convertible_v<Eigen::MatrixXi&, IndexView>);

std::vector<Triangle> seen(const IndexView& view) {
  OwnElements converted;
  const auto triangles = view.list(std::numeric_limits<std::int32_t>::max(), converted).triangles();
  REQUIRE(view.size() == triangles.size());
  return {triangles.begin(), triangles.end()};
}

template <class T>
void check_type(const Mesh& mesh) {
  const auto indices = mesh.indices();
  const std::vector<T> numbers(indices.begin(), indices.end());
  CHECK(seen(numbers) == mesh.triangles);
  CHECK(seen(std::span(numbers)) == mesh.triangles);
  std::vector<std::array<T, 3>> triples;
  Eigen::Matrix<T, 3, Eigen::Dynamic> columns(3, static_cast<Eigen::Index>(mesh.triangles.size()));
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> rows(static_cast<Eigen::Index>(mesh.triangles.size()), 3);
  for (const Triangle& t : mesh.triangles) {
    const auto row = static_cast<Eigen::Index>(triples.size());
    triples.push_back({static_cast<T>(t[0]), static_cast<T>(t[1]), static_cast<T>(t[2])});
    for (Eigen::Index k = 0; k < 3; ++k) {
      columns(k, row) = rows(row, k) = triples.back()[static_cast<std::size_t>(k)];
    }
  }
  CHECK(seen(triples) == mesh.triangles);
  CHECK(seen(columns) == mesh.triangles);
  CHECK(seen(columns.transpose()) == mesh.triangles);
  CHECK(seen(trismooth::triangle_rows(rows)) == mesh.triangles);
  using Map = Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  CHECK(seen(Map(numbers.data(), static_cast<Eigen::Index>(triples.size()), 3)) == mesh.triangles);
}

TEST_CASE("vertex numbers of every type, in every form of memory, are the same triangles") {
  const Mesh mesh = test_meshes::shuffled(test_meshes::jittered_grid(5, 6, 0.3, 3), 5);
  check_type<std::int32_t>(mesh);
  check_type<std::uint32_t>(mesh);
  check_type<std::int64_t>(mesh);
  check_type<std::uint64_t>(mesh);
  check_type<long long>(mesh);
  check_type<std::size_t>(mesh);
}

template <class T>
void check_type_of_four() {
  const std::vector<std::array<T, 4>> listed{{0, 1, 2, 3}, {3, 2, 4, static_cast<T>(-1)}};
  const IndexView view(listed);
  REQUIRE(view.may_have_quadrilaterals());
  OwnElements converted;
  const auto elements = view.list(5, converted).as<trismooth::MixedElement>();
  REQUIRE(elements.size() == 2);
  CHECK(elements[0] == trismooth::MixedElement{0, 1, 2, 3});
  CHECK(elements[1] == trismooth::MixedElement{3, 2, 4, trismooth::no_corner});
  CHECK(converted.list().empty() == (std::is_same_v<T, std::int32_t>));
}

TEST_CASE("four vertex numbers of every type are the same elements, and -1 in the last place is a triangle") {
  check_type_of_four<std::int32_t>();
  check_type_of_four<std::uint32_t>();
  check_type_of_four<std::int64_t>();
  check_type_of_four<std::uint64_t>();
  OwnElements converted;
  const std::vector<std::array<std::int64_t, 4>> too_large{{0, 1, 2, std::int64_t{1} << 32}};
  CHECK(refusal([&] { static_cast<void>(IndexView(too_large).list(5, converted)); }) ==
        "mesh: element 0 names vertex 4294967296; vertices are numbered from 0 to 4");
  const std::vector<Triangle> triangles{{0, 1, 2}};
  CHECK_FALSE(IndexView(triangles).may_have_quadrilaterals());
}

TEST_CASE("triangles of int32 are read where they are") {
  const Mesh mesh = test_meshes::star(5);
  const std::vector<std::int32_t> indices(mesh.indices().begin(), mesh.indices().end());
  OwnElements converted;
  CHECK(static_cast<const void*>(IndexView(indices).list(6, converted).triangles().data()) == indices.data());
  CHECK(static_cast<const void*>(IndexView(mesh.triangles).list(6, converted).triangles().data()) ==
        mesh.triangles.data());
  CHECK(converted.list().empty());
}

TEST_CASE("a number that 32 bits cannot hold is no other vertex by accident") {
  std::vector<double> xy = test_meshes::star(5).xy();
  const std::vector<double> before = xy;
  const auto refuses = [&](const auto& triangles, const std::string& expected) {
    CHECK(refusal([&] { smooth(trismooth::xy_points(xy), triangles); }) == expected);
  };
  refuses(std::vector<std::int64_t>{0, 1, 2, 0, 2, (std::int64_t{1} << 32) + 3},
          "mesh: triangle 1 names vertex 4294967299; vertices are numbered from 0 to 5");
  refuses(std::vector<std::uint64_t>{0, 1, ~std::uint64_t{0}},
          "mesh: triangle 0 names vertex 18446744073709551615; vertices are numbered from 0 to 5");
  refuses(std::vector<std::uint32_t>{0, 1, ~std::uint32_t{0}},
          "mesh: triangle 0 names vertex 4294967295; vertices are numbered from 0 to 5");
  refuses(std::vector<std::int64_t>{0, 1, -1}, "mesh: triangle 0 names vertex -1; vertices are numbered from 0 to 5");
  refuses(std::vector<std::size_t>{0, 1, 6}, "mesh: triangle 0 names vertex 6; vertices are numbered from 0 to 5");
  refuses(std::vector<std::size_t>{0, 1, 2, 3}, "argument: triangles has 4 entries, not three a triangle");
  CHECK(refusal([&] {
          const Eigen::MatrixXi quads = Eigen::MatrixXi::Zero(2, 4);
          smooth(trismooth::xy_points(xy), trismooth::triangle_rows(quads));
        }) == "mesh: element 0 repeats a vertex; of a triangle the last of four numbers is -1");
  CHECK(refusal([&] {
          const Eigen::MatrixXi fives = Eigen::MatrixXi::Zero(2, 5);
          smooth(trismooth::xy_points(xy), trismooth::triangle_rows(fives));
        }) == "argument: triangles: 5 vertex numbers each, expected three or four");
  CHECK(xy == before);
  CHECK(refusal([] { static_cast<void>(trismooth::plan(std::int64_t{1} << 31, std::span<const int>{})); }) ==
        "mesh: more than 2147483647 vertices");
}

}  // namespace trismooth::index_view_test

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/packed_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <zlib.h>

#include "trismooth/base/machine/workers.h"
#include "trismooth/quality/metrics.h"

#include "catch.h"

namespace trismooth::packed_picture_test {

using Numbers = std::vector<std::uint32_t>;

std::string decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 255U);
    }
  }
  return bytes;
}

/// As a reader of the page gets them, who knows what the header says.
std::map<std::string, Numbers> unpacked(const PackedPicture& packed) {
  std::string text;
  for (const PackedStream& stream : packed.streams) {
    text += stream.text;
  }
  const std::string bytes = decoded(text);
  std::map<std::string, Numbers> streams;
  std::size_t at = 0;
  for (const PackedStream& stream : packed.streams) {
    std::string planes(stream.count * static_cast<std::size_t>(stream.planes), '\0');
    uLongf size = planes.size();
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                       reinterpret_cast<const Bytef*>(bytes.data() + at), stream.bytes) == Z_OK);
    REQUIRE(size == planes.size());
    at += (stream.bytes + 2) / 3 * 3;
    Numbers& numbers = streams[stream.name];
    numbers.assign(stream.count, 0);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      numbers[i % stream.count] |= static_cast<std::uint32_t>(static_cast<unsigned char>(planes[i]))
                                   << (8 * (i / stream.count));
    }
  }
  REQUIRE(at == bytes.size());
  return streams;
}

std::int64_t signed_of(std::uint32_t number) {
  return (number & 1U) != 0 ? -static_cast<std::int64_t>(number / 2) - 1 : static_cast<std::int64_t>(number / 2);
}

/// An element of a page: its number, its corners' places before and now.
struct Shown {
  std::vector<Point2<double>> before;
  std::vector<Point2<double>> now;
  std::uint32_t region = 0;
};

std::map<std::int64_t, Shown> elements_of(const PackedPicture& packed, bool has_moved) {
  std::map<std::string, Numbers> s = unpacked(packed);
  std::vector<Point2<double>> before;
  std::vector<Point2<double>> now;
  Point2<double> steps{0, 0};
  const auto place = [&](Point2<double> p) {
    return Point2<double>{packed.origin.x + p.x * packed.step, packed.origin.y + p.y * packed.step};
  };
  for (std::size_t v = 0; v < static_cast<std::size_t>(packed.vertices); ++v) {
    steps.x += static_cast<double>(signed_of(s["x"][v]));
    steps.y += static_cast<double>(signed_of(s["y"][v]));
    before.push_back(place(steps));
    now.push_back(has_moved ? place({steps.x + static_cast<double>(signed_of(s["dx"][v])),
                                     steps.y + static_cast<double>(signed_of(s["dy"][v]))})
                            : before.back());
  }
  std::map<std::int64_t, Shown> elements;
  std::vector<std::int64_t> numbers;
  std::int64_t first = 0;
  std::int64_t number = 0;
  const auto triangles = static_cast<std::size_t>(packed.triangles);
  for (std::size_t e = 0; e < s["a"].size(); ++e) {
    first += signed_of(s["a"][e]);
    number += signed_of(s["number"][e]);
    numbers.push_back(number);
    std::vector<std::int64_t> corners{first, first + s["b"][e], first + s["c"][e]};
    if (e >= triangles) {
      corners.push_back(first + s["d"][e - triangles]);
    }
    Shown& shown = elements[number];
    for (const std::int64_t v : corners) {
      shown.before.push_back(before.at(static_cast<std::size_t>(v)));
      shown.now.push_back(now.at(static_cast<std::size_t>(v)));
    }
    shown.region = s.contains("region") ? s["region"][e] : 0;
  }
  auto exact = [&, at = std::size_t{0}](std::vector<Point2<double>>& points) mutable {
    for (Point2<double>& point : points) {
      std::array<double, 2> halves{};
      std::memcpy(halves.data(), s["exactplaces"].data() + at, sizeof halves);
      at += 4;
      point = place({halves[0] - packed.base.x, halves[1] - packed.base.y});
    }
  };
  for (const std::uint32_t e : s["exact"]) {
    Shown& shown = elements[numbers[e]];
    exact(shown.before);
    if (has_moved) {
      exact(shown.now);
    } else {
      shown.now = shown.before;
    }
  }
  return elements;
}

double shape_of(const std::vector<Point2<double>>& p) {
  return p.size() == 3 ? evaluate(Metric::shape, p[0], p[1], p[2]) : evaluate(Metric::shape, p[0], p[1], p[2], p[3]);
}

/// A grid of squares and pairs of triangles whose vertices lie anywhere near their places, some of which have moved.
MeshPicture random_picture(int count, double shake, double unit, Point2<double> origin, std::mt19937& random) {
  std::uniform_real_distribution<double> move(-shake, shake);
  MeshPicture picture;
  for (int y = 0; y <= count; ++y) {
    for (int x = 0; x <= count; ++x) {
      const Point2<double> place{origin.x + unit * (x + move(random)), origin.y + unit * (y + move(random))};
      picture.before.push_back(place);
      picture.after.push_back({place.x + unit * move(random) / 4, place.y + unit * move(random) / 4});
    }
  }
  std::vector<MixedElement> elements;
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      const std::int32_t a = y * (count + 1) + x;
      if (random() % 2 == 0) {
        elements.push_back({a, a + 1, a + count + 2, a + count + 1});
      } else {
        elements.push_back({a + count + 2, a, a + 1, no_corner});
        elements.push_back({a, a + count + 2, a + count + 1, no_corner});
      }
    }
  }
  std::ranges::shuffle(elements, random);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    picture.numbers.push_back(static_cast<std::int32_t>(3 * e + 5));
    picture.regions.push_back(static_cast<std::int32_t>(e % 3));
  }
  picture.elements = std::move(elements);
  picture.region_names = {"a", "b", "c"};
  return picture;
}

PackedPicture pack_all(const MeshPicture& picture, int threads = 2) {
  std::vector<std::int32_t> shown(picture.elements.list().size());
  std::iota(shown.begin(), shown.end(), 0);
  Workers workers(threads);
  const OrderedPicture ordered = along_curve(picture, shown, workers);
  return pack_picture(ordered, mesh_lines(ordered.mesh), workers);
}

TEST_CASE("a page has every element with its number and region, its shape to 0.005, its validity exactly") {
  std::mt19937 random(3);
  for (const double shake : {0.0, 0.2, 0.7}) {
    for (const double unit : {1.0, 1e-250, 3e200}) {
      const Point2<double> origin = shake < 0.5 ? Point2<double>{0, 0} : Point2<double>{7e5 * unit, -3e6 * unit};
      const MeshPicture picture = random_picture(24, shake, unit, origin, random);
      const std::map<std::int64_t, Shown> shown = elements_of(pack_all(picture), true);
      const ElementList elements = picture.elements.list();
      REQUIRE(shown.size() == elements.size());
      for (std::size_t e = 0; e < elements.size(); ++e) {
        const Shown& seen = shown.at(picture.numbers[e]);
        REQUIRE(seen.before.size() == elements[e].size());
        CHECK(seen.region == static_cast<std::uint32_t>(picture.regions[e]));
        for (const bool is_now : {false, true}) {
          std::vector<Point2<double>> exact;
          for (const std::int32_t v : elements[e]) {
            const Point2<double> p = is_now ? picture.after[v] : picture.before[v];
            exact.push_back({(p.x - origin.x) / unit, (p.y - origin.y) / unit});
          }
          std::vector<Point2<double>> found = is_now ? seen.now : seen.before;
          for (Point2<double>& p : found) {
            p = {(p.x - origin.x) / unit, (p.y - origin.y) / unit};
          }
          CHECK(std::abs(shape_of(found) - shape_of(exact)) < 0.0051);
          CHECK((shape_of(found) > 0) == (shape_of(exact) > 0));
        }
      }
    }
  }
}

TEST_CASE("elements that are listed clockwise come counter-clockwise") {
  MeshPicture picture;
  picture.before = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  picture.elements = std::vector<Triangle>{{0, 2, 1}, {1, 3, 2}};
  picture.reversed_before = {1, 0};
  for (const auto& [number, element] : elements_of(pack_all(picture), false)) {
    CHECK(shape_of(element.now) > 0.8);
  }
}

TEST_CASE("an element far flatter than a step is not shown as inverted or flat") {
  MeshPicture picture;
  picture.before = {{0, 0}, {1, 0}, {0.5, 1e-13}, {0.5, 1}};
  picture.elements = std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {2, 1, 3}};
  const auto shown = elements_of(pack_all(picture), false);
  CHECK(shape_of(shown.at(0).now) > 0);
  CHECK(shape_of(shown.at(0).now) < 1e-12);
}

TEST_CASE("elements far smaller than the rounding of the domain's rim come with their shape") {
  // Around (0, 0), where coordinates have more digits than from the rim on.
  MeshPicture picture;
  constexpr double small = 0x1p-70;
  picture.before = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {small, 0}, {-small, 0}, {0, small}};
  picture.elements = std::vector<Triangle>{{4, 6, 5}, {0, 1, 4}, {2, 3, 6}};
  const PackedPicture packed = pack_all(picture);
  const std::map<std::string, Numbers> streams = unpacked(packed);
  REQUIRE(streams.contains("exact"));
  const Numbers& exact = streams.at("exact");
  // Metrics take exact corners as they are.
  std::vector<double> shapes;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    std::array<double, 6> p{};
    std::memcpy(p.data(), streams.at("exactplaces").data() + 12 * i, sizeof p);
    shapes.push_back(evaluate(Metric::shape, {p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}));
  }
  const double wanted = evaluate(Metric::shape, {1, 0}, {0, 1}, {-1, 0});
  CHECK(std::ranges::any_of(shapes, [&](double shape) { return std::abs(shape - wanted) < 1e-12; }));
}

TEST_CASE("the same picture is packed to the same bytes by any number of threads") {
  std::mt19937 random(8);
  const MeshPicture picture = random_picture(200, 0.4, 1, {0, 0}, random);
  const PackedPicture one = pack_all(picture, 1);
  const PackedPicture three = pack_all(picture, 3);
  CHECK(std::ranges::equal(one.streams, three.streams, {}, &PackedStream::text, &PackedStream::text));
}

TEST_CASE("a part of a mesh has its elements and their vertices alone") {
  std::mt19937 random(5);
  const MeshPicture picture = random_picture(8, 0.1, 1, {0, 0}, random);
  const std::vector<std::int32_t> some{3, 10, 11};
  Workers workers(1);
  const PackedPicture packed = pack_picture(along_curve(picture, some, workers), {}, workers);
  const auto shown = elements_of(packed, true);
  REQUIRE(shown.size() == 3);
  CHECK(shown.contains(3 * 10 + 5));
  CHECK(packed.vertices <= 12);
}

TEST_CASE("a picture without elements, and one of a single place, are packed") {
  CHECK(pack_all({}).vertices == 0);
  MeshPicture picture;
  picture.before = {{2, 2}, {2, 2}, {2, 2}};
  picture.elements = std::vector<Triangle>{{0, 1, 2}};
  CHECK(elements_of(pack_all(picture), false).at(0).now[1].x == 2);
}

}  // namespace trismooth::packed_picture_test

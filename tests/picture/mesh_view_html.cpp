// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/mesh_view_html.h"

#include <algorithm>
#include <string>
#include <vector>

#include "trismooth/base/machine/workers.h"

#include "catch.h"
#include "picture/sample_picture.h"
#include "support/parsed_page.h"

namespace trismooth::mesh_view_html_test {

std::string html_of(const MeshPicture& picture, std::int64_t most = 1000) {
  Workers workers(1);
  std::string html;
  add_mesh_view(html, picture, workers, most);
  return html;
}

pages::Parsed view_of(const MeshPicture& picture, std::int64_t most = 1000) {
  pages::Parsed page = pages::parse("<main>" + html_of(picture, most) + "</main>");
  CHECK(page.error.empty());
  return page;
}

const pages::Element& part(const pages::Parsed& page, const std::string& id) {
  for (const pages::Element& element : page.elements) {
    if (element.attribute("id") == id) {
      return element;
    }
  }
  FAIL("there is no " << id);
  return page.elements.front();
}

TEST_CASE("a page carries the mesh, its script and a still picture, and asks for nothing else") {
  MeshPicture picture = samples::mixed();
  picture.worst_before = {1};
  const pages::Parsed page = view_of(picture);
  CHECK(page.count("canvas") == 1);
  CHECK(page.count("script") == 3);  // what there is to know, the numbers, the code
  REQUIRE(page.links.size() == 1);
  CHECK(page.links.front().starts_with("data:image/png;base64,"));
  const std::string about = part(page, "mesh-about").text;
  CHECK(about.find("\"triangles\":1,\"quadrilaterals\":1") != std::string::npos);
  CHECK(about.find("\"before\":[1]") != std::string::npos);
  CHECK(about.find("\"moved\":false") != std::string::npos);
  CHECK(about.find("\"backdrop\":null") != std::string::npos);
}

TEST_CASE("what only one kind of element has, regions and moves are offered where there are some") {
  const auto offered = [](const MeshPicture& picture) {
    std::vector<std::string> names;
    for (const pages::Element& option : view_of(picture).all("option")) {
      names.push_back(option.attribute("value"));
    }
    return names;
  };
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::count(names, name) == 1;
  };
  MeshPicture picture = samples::square();
  CHECK(has(offered(picture), "radius_ratio"));
  CHECK_FALSE(has(offered(picture), "skew"));
  CHECK_FALSE(has(offered(picture), "region"));
  CHECK_FALSE(has(offered(picture), "moved"));
  picture.after = picture.before;
  CHECK(has(offered(picture), "moved"));
  CHECK(has(offered(samples::mixed()), "skew"));
  CHECK(has(offered(samples::mixed()), "region"));
}

TEST_CASE("names of regions cannot end the text that they are in") {
  MeshPicture picture = samples::mixed();
  picture.region_names = {"</script><script>alert(1)</script>", "a & b ]]> \xff\" \\"};
  const std::string html = html_of(picture);
  CHECK(pages::count_of(html, "</script>") == 3);
  CHECK(view_of(picture).count("script") == 3);
  const std::string about = part(view_of(picture), "mesh-about").text;
  CHECK(about.find('<') == std::string::npos);
  CHECK(about.find("\\u003c/script\\u003e\\u003cscript\\u003ealert(1)") != std::string::npos);
  CHECK(about.find("a \\u0026 b ]]\\u003e \\ufffd\\\" \\\\") != std::string::npos);
}

TEST_CASE("of a large mesh a page has a picture and the elements around the worst ones") {
  // A row of squares, the worst at its end.
  MeshPicture picture;
  std::vector<MixedElement> squares;
  for (std::int32_t x = 0; x <= 100; ++x) {
    picture.before.push_back({static_cast<double>(x), 0});
    picture.before.push_back({static_cast<double>(x), 1});
    if (x < 100) {
      squares.push_back({2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1});
    }
  }
  picture.elements = std::move(squares);
  picture.worst_before = {99};
  const pages::Parsed page = view_of(picture, 99);
  const std::string about = part(page, "mesh-about").text;
  // The square reaches 12 sides to either side of the worst one's middle, at 99.5.
  CHECK(about.find("\"quadrilaterals\":13") != std::string::npos);
  CHECK(about.find("\"backdrop\":{\"lowX\"") != std::string::npos);
  CHECK(page.says("The mesh has 100 elements, which are more than a page can show one by one (99)"));
  CHECK(part(view_of(picture, 100), "mesh-about").text.find("\"quadrilaterals\":100") != std::string::npos);
}

TEST_CASE("a mesh of a single place has a page") {
  MeshPicture picture;
  picture.before.assign(3, {5, 5});
  picture.elements = std::vector<Triangle>{{0, 1, 2}};
  CHECK(view_of(picture).count("canvas") == 1);
}

}  // namespace trismooth::mesh_view_html_test

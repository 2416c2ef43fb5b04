// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/document/array_names.h"

#include <cstdint>
#include <string>
#include <vector>

#include "catch.h"

using trismooth::DataArray;
using trismooth::find_array_loosely;
using trismooth::make_data_array;
using trismooth::plain_name;

TEST_CASE("plain names have letters in lower case and digits, and bytes of other alphabets") {
  CHECK(plain_name("Material_ID") == "materialid");
  CHECK(plain_name("material id") == "materialid");
  CHECK(plain_name("gmsh:physical") == "gmshphysical");
  CHECK(plain_name(" Zone-2 ") == "zone2");
  CHECK(plain_name("gr\xc3\xb6\xc3\x9f"
                   "e") ==
        "gr\xc3\xb6\xc3\x9f"
        "e");
  CHECK(plain_name("__").empty());
}

TEST_CASE("an array is found by its exact name first, then by its plain one") {
  const auto one = [](const std::string& name) { return make_data_array(name, 1, std::vector<std::int32_t>{1}); };
  const std::vector<DataArray> arrays{one("Mat ID"), one("mat_id"), one("_")};
  CHECK(find_array_loosely(arrays, "mat_id") == &arrays[1]);
  CHECK(find_array_loosely(arrays, "MATID") == &arrays[0]);
  CHECK(find_array_loosely(arrays, "-") == nullptr);
  CHECK(find_array_loosely(arrays, "other") == nullptr);
  CHECK(trismooth::array_names(arrays) == "Mat ID, mat_id, _");
  CHECK(trismooth::array_names({}) == "none");
}

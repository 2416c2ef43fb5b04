// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/picture/picture_file.h"

#include <stdexcept>
#include <string>

#include "trismooth/pipeline/picture/png_text.h"

#include "catch.h"
#include "picture/sample_picture.h"

namespace trismooth::picture_file_test {

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("the extension says which kind of picture it is, and others are refused") {
  const MeshPicture picture = samples::square();
  CHECK(picture_file("a.SVG", picture, {}).bytes.starts_with("<svg "));
  CHECK(picture_file("a.png", picture, {}).bytes.starts_with("\x89PNG\r\n\x1a\n"));
  for (const char* const name : {"a.jpg", "a", "-", ".svg"}) {
    CAPTURE(name);
    CHECK(message_of([&] { require_picture_extension(name); }) ==
          "'" + std::string(name) + "' is no picture file; its name must end in .svg or .png");
  }
}

TEST_CASE("a window is four numbers of a part of the plane") {
  const Box window = picture_window("-1,2.5,1e1,3");
  CHECK(window.low == Point2<double>{-1, 2.5});
  CHECK(window.high == Point2<double>{10, 3});
  for (const char* const text : {"", "1,2,3", "1,2,3,4,5", "a,b,c,d", "1,2,3,", "1,2,3,inf", "nan,0,1,1", "1;2;3;4"}) {
    CAPTURE(text);
    CHECK(message_of([&] { picture_window(text); }) ==
          "expected four numbers, x0,y0,x1,y1, got '" + std::string(text) + "'");
  }
  for (const char* const text : {"1,0,1,2", "0,2,1,2", "3,0,1,2"}) {
    CAPTURE(text);
    CHECK(message_of([&] { picture_window(text); }).find("is empty") != std::string::npos);
  }
}

TEST_CASE("a window where nothing is, is told, with what there is") {
  PictureFileOptions options;
  options.window = picture_window("10,10,11,11");
  CHECK(picture_file("a.png", samples::square(), options).note ==
        "it is empty: nothing of the mesh is in the window 10,10,11,11; the mesh spans 0,0,2,2");
  options.window = picture_window("1,1,11,11");
  CHECK(picture_file("a.png", samples::square(), options).note.empty());
}

TEST_CASE("windows are named as people name places") {
  MeshPicture picture = samples::square();
  picture.place_shown = [](Point2<double> place) { return Point2<double>{place.x - 100, place.y / 2}; };
  picture.shown_place = [](Point2<double> place) { return Point2<double>{place.x + 100, place.y * 2}; };
  PictureFileOptions options;
  options.window = picture_window("100,0,102,4");
  CHECK(picture_file("a.svg", picture, options).note.empty());
  options.window = picture_window("0,0,2,2");
  CHECK(picture_file("a.svg", picture, options).note.find("the mesh spans 100,0,102,4") != std::string::npos);
}

TEST_CASE("the same mesh gives the same bytes, on any number of threads") {
  PictureFileOptions options;
  options.worst = 2;
  options.threads = 1;
  const std::string one = picture_file("a.png", samples::mixed(), options).bytes;
  options.threads = 3;
  CHECK(picture_file("a.png", samples::mixed(), options).bytes == one);
}

TEST_CASE("a picture without pixels is no PNG") {
  CHECK_THROWS_AS(png_text({}), std::invalid_argument);
}

}  // namespace trismooth::picture_file_test

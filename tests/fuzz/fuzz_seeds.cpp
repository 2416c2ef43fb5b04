// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "targets.h"

/// fuzz_seeds FOLDER: writes the seeds of every target into a folder of its name in FOLDER, and prints these names, a
/// line each.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
    return 2;
  }
  try {
    for (const fuzz::Target& target : fuzz::all_targets()) {
      const std::filesystem::path folder = std::filesystem::path(argv[1]) / target.name;
      std::filesystem::create_directories(folder);
      for (const fuzz::Seed& seed : fuzz::seeds_of(target)) {
        std::ofstream file(folder / seed.name, std::ios::binary);
        file << seed.bytes;
        file.close();
        if (!file) {
          std::fprintf(stderr, "%s cannot be written\n", (folder / seed.name).c_str());
          return 1;
        }
      }
      std::printf("%s\n", std::string(target.name).c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

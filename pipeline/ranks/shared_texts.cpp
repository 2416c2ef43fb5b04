// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/ranks/shared_texts.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace trismooth {

std::vector<std::string> texts_of_all(const std::set<std::string>& own, const mpi::Communicator& ranks) {
  std::vector<char> bytes;
  for (const std::string& text : own) {
    bytes.insert(bytes.end(), text.begin(), text.end());
    bytes.push_back('\0');
  }
  bytes = ranks.of_all(bytes);
  std::set<std::string> all;
  for (auto at = bytes.begin(); at != bytes.end();) {
    const auto end = std::find(at, bytes.end(), '\0');
    all.emplace(at, end);
    at = end + 1;
  }
  return {all.begin(), all.end()};
}

void put_in_front(const std::vector<std::string>& sentences, std::vector<std::string>& all) {
  std::vector<std::string> joined = sentences;
  std::ranges::copy_if(all, std::back_inserter(joined), [&](const std::string& sentence) {
    return std::ranges::find(sentences, sentence) == sentences.end();
  });
  all = std::move(joined);
}

std::vector<char> first_bytes(const std::vector<char>& own, const mpi::Communicator& ranks) {
  auto sent = mpi::lists_by_rank<char>(ranks);
  sent[0] = own;
  const mpi::ByRank<char> received = ranks.exchanged(sent);
  const auto first = std::ranges::find_if(received, [](const std::vector<char>& bytes) { return !bytes.empty(); });
  std::vector<char> bytes = first == received.end() ? std::vector<char>{} : *first;
  ranks.broadcast(bytes);
  return bytes;
}

}  // namespace trismooth

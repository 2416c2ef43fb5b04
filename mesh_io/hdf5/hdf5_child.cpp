// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mesh_io/hdf5/hdf5_child.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "trismooth/mesh_io/bytes/saturating_product.h"
#include "trismooth/mesh_io/hdf5/hdf5_handle.h"

namespace trismooth {

namespace {

/// In front of every answer.
struct Header {
  std::uint64_t size = 0;
  std::uint64_t is_refusal = 0;
};

/// What is sent at a time: a message of any size grows in such steps.
constexpr std::size_t step = std::size_t{1} << 20;
constexpr std::uint64_t longest_sentence = 4096;

/// False where nobody listens any more.
bool send_all(int socket, const void* bytes, std::size_t size) {
  for (const char* at = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t sent = ::send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) {
      return false;
    }
    at += std::max<ssize_t>(sent, 0);
    size -= static_cast<std::size_t>(std::max<ssize_t>(sent, 0));
  }
  return true;
}

/// False at the end of what is sent.
bool receive_all(int socket, void* bytes, std::size_t size) {
  for (char* at = static_cast<char*>(bytes); size > 0;) {
    const ssize_t got = ::recv(socket, at, size, 0);
    if (got == 0 || (got < 0 && errno != EINTR)) {
      return false;
    }
    at += std::max<ssize_t>(got, 0);
    size -= static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  }
  return true;
}

/// Signals that something is wrong end a process, whatever the one that it is a copy of would do; of all others, which
/// come from a terminal or are that one's business, it takes no notice.
void reset_signals() {
  for (int signal = 1; signal < NSIG; ++signal) {
    switch (signal) {
      case SIGSEGV:
      case SIGBUS:
      case SIGFPE:
      case SIGILL:
      case SIGABRT:
      case SIGTRAP:
      case SIGSYS:
      case SIGXCPU:
        std::signal(signal, SIG_DFL);
        break;
      default:
        std::signal(signal, SIG_IGN);
    }
  }
  sigset_t none;
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// Keeps `socket` alone, as the descriptor that is returned; what is printed goes nowhere.
int keep_only(int socket) {
  constexpr int kept = 3;
  if (socket != kept) {
    ::dup2(socket, kept);
  }
#ifdef SYS_close_range
  const bool closed = ::syscall(SYS_close_range, kept + 1, ~0U, 0) == 0;
#else
  constexpr bool closed = false;
#endif
  for (int other = kept + 1; !closed && other < 4096; ++other) {
    ::close(other);
  }
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int standard = 0; standard < kept; ++standard) {
    if (nowhere < 0) {
      ::close(standard);
    } else {
      ::dup2(nowhere, standard);
    }
  }
  if (nowhere > kept) {
    ::close(nowhere);
  }
  return kept;
}

void limit(decltype(RLIMIT_CPU) what, std::uint64_t soft, std::uint64_t hard) {
  rlimit limits{};
  if (::getrlimit(what, &limits) == 0) {
    limits.rlim_max = std::min<rlim_t>(limits.rlim_max, hard);
    limits.rlim_cur = std::min<rlim_t>({limits.rlim_cur, limits.rlim_max, soft});
    ::setrlimit(what, &limits);
  }
}

void set_limits(const Hdf5Child::Limits& limits) {
  // No file is opened, made or written, and no process either.
  std::uint64_t pages = 0;
  if (std::ifstream("/proc/self/statm") >> pages) {
    const std::uint64_t memory = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    const std::uint64_t all = memory + std::min(limits.memory, ~memory);
    limit(RLIMIT_AS, all, all);
  }
  limit(RLIMIT_CPU, limits.seconds, limits.seconds + 1);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_FSIZE, 0, 0);
  limit(RLIMIT_NPROC, 0, 0);
  limit(RLIMIT_NOFILE, 0, 0);
}

[[noreturn]] void run_child(int socket, const Hdf5Child::Limits& limits,
                            const std::function<void(Hdf5Channel&)>& serve) {
  reset_signals();
  Hdf5Channel channel(keep_only(socket));
  set_limits(limits);
  try {
    serve(channel);
  } catch (...) {
    std::abort();
  }
  // Nothing of what the parent would do at its end: flush streams, finish MPI, call Python.
  ::_exit(0);
}

}  // namespace

std::optional<std::string> Hdf5Channel::next() {
  std::uint64_t size = 0;
  if (!receive_all(socket_, &size, sizeof(size))) {
    return std::nullopt;
  }
  std::string request(static_cast<std::size_t>(size), '\0');
  return receive_all(socket_, request.data(), request.size()) ? std::optional(std::move(request)) : std::nullopt;
}

void Hdf5Channel::send(bool is_refusal, std::string_view payload) const {
  const Header header{payload.size(), is_refusal ? 1U : 0U};
  if (!send_all(socket_, &header, sizeof(header)) || !send_all(socket_, payload.data(), payload.size())) {
    ::_exit(0);
  }
}

Hdf5Child::Limits Hdf5Child::limits_of(std::uint64_t file_bytes) {
  // Unpacking makes at most some thousand bytes of one, and these may be converted to larger numbers.
  constexpr std::uint64_t bytes_of_one = 10000;
  return {5 + 2 * (file_bytes >> 20),
          saturating_product(bytes_of_one, file_bytes + (std::uint64_t{256} << 20) / bytes_of_one)};
}

Hdf5Child::Hdf5Child(const Limits& limits, const std::function<void(Hdf5Channel&)>& serve)
    : patience_(saturating_product(10, limits.seconds)) {
  std::array<int, 2> sockets{-1, -1};
  int reason = 0;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) {
    reason = errno;
  } else {
    // The library is nobody else's for the moment, and is copied in one piece; ready for use, which costs once then.
    const Hdf5Lock lock;
    H5open();
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    process_ = ::fork();
    reason = errno;
    if (process_ == 0) {
      run_child(sockets[1], limits, serve);
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ::close(sockets[1]);
    socket_ = sockets[0];
  }
  if (process_ < 0) {
    if (socket_ >= 0) {
      ::close(socket_);
    }
    throw Hdf5ChildLost(
        "is read by HDF5 in a process of its own, and none can be made: " + std::generic_category().message(reason) +
        " (are there too many processes or open files, see 'ulimit -u' and 'ulimit -n'?)");
  }
}

Hdf5Child::~Hdf5Child() {
  end();
}

/// How it ended, where that is known.
std::optional<int> Hdf5Child::end() {
  if (socket_ < 0) {
    return std::nullopt;
  }
  // A child reads the end of requests, and ends; a moment later its end of the connection is gone. One that is killed
  // is still there, so that nobody else has its number.
  ::shutdown(socket_, SHUT_WR);
  std::array<char, 4096> rest{};
  for (std::uint64_t waited = 0; waited < 100;) {
    const ssize_t got = ::recv(socket_, rest.data(), rest.size(), MSG_DONTWAIT);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) {
      break;
    }
    pollfd events{socket_, POLLIN, 0};
    waited += got > 0 || ::poll(&events, 1, 10) == 0 ? 1 : 0;
    if (waited == 100) {
      ::kill(process_, SIGKILL);
    }
  }
  ::close(socket_);
  socket_ = -1;
  // Where the program around this one wants no news of children there is none to wait for.
  int status = 0;
  pid_t ended = 0;
  do {
    ended = ::waitpid(process_, &status, 0);
  } while (ended < 0 && errno == EINTR);
  return ended == process_ ? std::optional(status) : std::nullopt;
}

void Hdf5Child::lose() {
  const std::optional<int> status = end();
  if (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGXCPU) {
    throw Hdf5ChildLost("is damaged: HDF5's library comes to no end with it");
  }
  if (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGKILL) {
    throw Hdf5ChildLost("cannot be read: HDF5's process was killed, as happens where memory runs out");
  }
  throw Hdf5ChildLost();
}

void Hdf5Child::wait_for(short events) {
  // Second by second: one in which this process is stopped as well counts no more than others.
  for (std::uint64_t silent = 0; silent < patience_;) {
    pollfd waiting{socket_, events, 0};
    const int ready = ::poll(&waiting, 1, 1000);
    if (ready > 0) {
      return;
    }
    silent += ready == 0 ? 1 : 0;
  }
  ::kill(process_, SIGKILL);
  end();
  throw Hdf5ChildLost("is damaged: HDF5's library gives no answer");
}

void Hdf5Child::ask(std::string_view request) {
  const std::uint64_t size = request.size();
  std::string all(reinterpret_cast<const char*>(&size), sizeof(size));
  all.append(request);
  for (std::string_view rest = all; !rest.empty();) {
    const ssize_t sent = socket_ < 0 ? -1 : ::send(socket_, rest.data(), rest.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(sent));
    } else if (socket_ >= 0 && errno == EAGAIN) {
      wait_for(POLLOUT);
    } else if (socket_ < 0 || errno != EINTR) {
      lose();
    }
  }
}

void Hdf5Child::receive(void* to, std::size_t size) {
  for (char* at = static_cast<char*>(to); size > 0;) {
    const ssize_t got = socket_ < 0 ? 0 : ::recv(socket_, at, size, MSG_DONTWAIT);
    if (got > 0) {
      at += got;
      size -= static_cast<std::size_t>(got);
    } else if (got < 0 && errno == EAGAIN) {
      wait_for(POLLIN);
    } else if (got == 0 || errno != EINTR) {
      lose();
    }
  }
}

std::uint64_t Hdf5Child::answer_size() {
  Header header;
  receive(&header, sizeof(header));
  if (header.is_refusal == 0) {
    return header.size;
  }
  std::string sentence(static_cast<std::size_t>(std::min(header.size, longest_sentence)), '\0');
  receive(sentence.data(), sentence.size());
  std::ranges::replace_if(
      sentence, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }, '?');
  throw Hdf5Refusal(sentence);
}

std::string Hdf5Child::answer(std::uint64_t most) {
  const std::uint64_t size = answer_size();
  if (size > most) {
    lose();
  }
  std::string all;
  while (all.size() < size) {
    const std::size_t had = all.size();
    all.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size, std::max(step, 2 * had))));
    receive(all.data() + had, all.size() - had);
  }
  return all;
}

}  // namespace trismooth

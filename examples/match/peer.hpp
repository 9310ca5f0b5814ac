/* The sockets of match.cpp, of POSIX systems. */
#pragma once

#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

/* A program at the other end: what it has got of the lines, and what has come from it. */
struct peer {
  int socket;
  bool plays = false;
  std::size_t sent = 0;
  std::string come{};

  void tell(const std::string &text) const {
    ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
  }
  void update(const std::string &lines) {
    tell(lines.substr(sent));
    sent = lines.size();
  }
  /* The next line; empty where the other has left. */
  std::string line() {
    char some[4096];
    for (std::size_t end; (end = come.find('\n')) == std::string::npos;) {
      const auto n = ::recv(socket, some, sizeof some, 0);
      if (n <= 0)
        return {};
      come.append(some, static_cast<std::size_t>(n));
    }
    std::string found = come.substr(0, come.find('\n') + 1);
    come.erase(0, found.size());
    return found;
  }
};

/* A socket on this machine: where others come, or to where one is. */
inline int local(int port, bool door) {
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(static_cast<std::uint16_t>(port));
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int made = ::socket(AF_INET, SOCK_STREAM, 0), on = 1;
  ::setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const auto *to = reinterpret_cast<const sockaddr *>(&at);
  if (door ? ::bind(made, to, sizeof at) < 0 || ::listen(made, 8) < 0
           : ::connect(made, to, sizeof at) < 0)
    throw std::runtime_error("port " + std::to_string(port) + " cannot be used");
  return made;
}

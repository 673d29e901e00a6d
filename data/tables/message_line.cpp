#include "tables/message_line.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace flexspline::data {

MessageLine::~MessageLine() { ::close(end_); }

bool MessageLine::send(const void* from, std::size_t count) const {
  const auto* at = static_cast<const char*>(from);
  while (count > 0) {
    const ssize_t sent = ::send(end_, at, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

MessageLine::Got MessageLine::receive(void* to, std::size_t count, double patience_s) const {
  auto* at = static_cast<char*>(to);
  while (count > 0) {
    if (!wait(patience_s)) return Got::late;
    const ssize_t got = ::recv(end_, at, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return Got::ended;
    at += got;
    count -= static_cast<std::size_t>(got);
  }
  return Got::all;
}

bool MessageLine::wait(double patience_s) const {
  pollfd watched{end_, POLLIN, 0};
  const int milliseconds = patience_s < 0.0 ? -1 : static_cast<int>(1000.0 * patience_s);
  int ready = 0;
  do {
    ready = ::poll(&watched, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

}  // namespace flexspline::data

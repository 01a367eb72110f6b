// SPDX-License-Identifier: Apache-2.0
#include "support/web_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <stdexcept>
#include <utility>

namespace ridgeline::testing {
namespace {

constexpr const char* kDate = "Mon, 02 Jun 2025 10:00:00 GMT";

// False: the client has hung up.
bool Send(int client, const std::string& text) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t count = ::send(client, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

// 100 MB of one letter.
std::string Packed() {
  std::string packed(1 << 20, '\0');
  const std::string letters(1 << 20, 'x');
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY);
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  for (int i = 0; i < 100; ++i) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(letters.data()));
    stream.avail_in = static_cast<uInt>(letters.size());
    deflate(&stream, i < 99 ? Z_NO_FLUSH : Z_FINISH);
  }
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace

WebServer::WebServer(std::map<std::string, std::string> files) : files_(std::move(files)) {
  socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(place);
  if (::bind(socket_, reinterpret_cast<sockaddr*>(&place), size) != 0 ||
      ::listen(socket_, 16) != 0 ||
      ::getsockname(socket_, reinterpret_cast<sockaddr*>(&place), &size) != 0) {
    throw std::runtime_error("no port for a test server");
  }
  port_ = ntohs(place.sin_port);
  thread_ = std::thread([this] { Serve(); });
}

WebServer::~WebServer() { Stop(); }

std::string WebServer::address() const { return "http://127.0.0.1:" + std::to_string(port_); }

void WebServer::Stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void WebServer::Serve() {
  while (!stopping_) {
    pollfd waiting{socket_, POLLIN, 0};
    if (::poll(&waiting, 1, 50) <= 0) continue;
    const int client = ::accept(socket_, nullptr, nullptr);
    if (client < 0) continue;
    Answer(client);
    ::close(client);
  }
}

void WebServer::SendForEver(int client, const std::string& piece, int pause_ms) const {
  while (!stopping_ && Send(client, piece)) {
    pollfd waiting{client, POLLIN, 0};
    if (::poll(&waiting, 1, pause_ms) > 0) return;  // the client has hung up
  }
}

void WebServer::Answer(int client) {
  std::string request;
  std::array<char, 2048> buffer{};
  while (request.find("\r\n\r\n") == std::string::npos) {
    const ssize_t count = ::recv(client, buffer.data(), buffer.size(), 0);
    if (count <= 0) return;
    request.append(buffer.data(), static_cast<std::size_t>(count));
  }
  const std::size_t begin = request.find('/');
  const std::string path = request.substr(begin, request.find(' ', begin) - begin);
  const std::size_t slash = path.find('/', 1);
  const std::string way = path.substr(0, slash);
  const auto file = slash == std::string::npos ? files_.end() : files_.find(path.substr(slash + 1));
  if (way == "/busy") {
    Send(
        client,
        "HTTP/1.1 500 Internal Server Error\r\nContent-Length: 4\r\nConnection: close\r\n\r\nbusy");
    return;
  }
  if (file == files_.end()) {
    Send(client, "HTTP/1.1 404 Not Found\r\nContent-Length: 7\r\nConnection: close\r\n\r\nnothing");
    return;
  }
  const std::string& body = file->second;
  if (way == "/whole" && !halves_ &&
      request.find(std::string("If-Modified-Since: ") + kDate) != std::string::npos) {
    Send(client, "HTTP/1.1 304 Not Modified\r\nConnection: close\r\n\r\n");
    return;
  }
  ++bodies_sent_;
  if (way == "/moved") {
    Send(client,
         "HTTP/1.1 302 Found\r\nLocation: file:///etc/hostname\r\nConnection: close\r\n\r\n");
    return;
  }
  if (way == "/drip") {
    Send(client, "HTTP/1.1 200 OK\r\nContent-Length: 1000000\r\nConnection: close\r\n\r\n");
    SendForEver(client, "x", 100);
    return;
  }
  if (way == "/trickle") {
    Send(client, "HTTP/1.0 200 OK\r\n\r\n");
    SendForEver(client, std::string(2000, 'x'), 100);
    return;
  }
  if (way == "/circle") {
    Send(client, "HTTP/1.0 302 Found\r\nLocation: /circle/a.txt\r\n\r\n");
    return;
  }
  if (way == "/endless") {
    Send(client, "HTTP/1.0 200 OK\r\n\r\n");
    SendForEver(client, std::string(1 << 16, 'x'), 0);
    return;
  }
  if (way == "/gzip") {
    Send(client,
         "HTTP/1.1 200 OK\r\nContent-Encoding: gzip\r\nConnection: close\r\n\r\n" + Packed());
    return;
  }
  if (way == "/undated") {
    Send(client, "HTTP/1.0 200 OK\r\n\r\n" + body);
    return;
  }
  Send(client,
       "HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(body.size()) +
           "\r\nLast-Modified: " + kDate + "\r\nConnection: close\r\n\r\n");
  Send(client, way == "/whole" && !halves_ ? body : body.substr(0, body.size() / 2));
  // Silent until the client hangs up.
  while (way == "/mute" && !stopping_) {
    pollfd waiting{client, POLLIN, 0};
    if (::poll(&waiting, 1, 50) > 0) return;
  }
}

}  // namespace ridgeline::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <map>
#include <string>
#include <thread>

namespace ridgeline::testing {

// A web server on a free port of this machine, well-behaved and not, by the first folder of the
// path:
//   /whole/NAME   the file, with its length and date; 304 if the client has it of that date
//   /undated/NAME the file without length and date
//   /half/NAME    says the whole length and sends half
//   /mute/NAME    says the whole length, sends half, and is silent until the client gives up
//   /busy/NAME    500
//   /drip/NAME    a byte every tenth of a second
//   /trickle/NAME 2 kB every tenth of a second, without end
//   /moved/NAME   302 to the file system: file:///etc/hostname
//   /circle/NAME  302 to itself
//   /endless/NAME no length, and no end until the client hangs up
//   /gzip/NAME    the same, packed: a few bytes that stand for very many
// and 404 for files that it does not have.
class WebServer {
 public:
  explicit WebServer(std::map<std::string, std::string> files);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  // "http://127.0.0.1:PORT"
  std::string address() const;
  // Answers given with a file's content, or part of it.
  int bodies_sent() const { return bodies_sent_; }
  // From now on /whole/ sends halves too, of files that have changed.
  void SendHalves() { halves_ = true; }
  // Closes the port; later clients find no one.
  void Stop();

 private:
  void Serve();
  void SendForEver(int client, const std::string& piece, int pause_ms) const;
  void Answer(int client);

  std::map<std::string, std::string> files_;
  int socket_ = -1;
  int port_ = 0;
  std::atomic<int> bodies_sent_ = 0;
  std::atomic<bool> halves_ = false;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace ridgeline::testing

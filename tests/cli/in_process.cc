// SPDX-License-Identifier: Apache-2.0
#include "cli/in_process.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <sstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/commands.h"

namespace ridgeline::testing {
namespace {

// Sends a stream into a text for as long as it lives.
class Capture {
 public:
  explicit Capture(std::ostream& stream) : stream_(stream), old_(stream.rdbuf(text_.rdbuf())) {}
  ~Capture() { stream_.rdbuf(old_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::ostream& stream_;
  std::streambuf* old_;
};

int Run(const std::vector<std::string>& words) {
  Context context;
  try {
    const auto app = MakeProgram(context);
    app->parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return context.run();
  } catch (const CLI::Success&) {
    return kExitOk;
  } catch (const CLI::ParseError& e) {
    std::cout << "error: " << e.what() << '\n';
    return kExitBadInput;
  } catch (const InputError& e) {
    RemoveTemporaries();
    std::cout << "error: " << e.what() << '\n';
    return kExitBadInput;
  } catch (const std::exception& e) {
    std::cout << "internal error: " << e.what() << '\n';
    return kExitInternal;
  }
}

}  // namespace

Outcome RunHere(const std::vector<std::string>& words) {
  Outcome outcome;
  const Capture out(std::cout);
  const Capture err(std::cerr);
  outcome.exit_code = Run(words);
  outcome.text = out.text();
  return outcome;
}

}  // namespace ridgeline::testing

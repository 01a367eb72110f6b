// SPDX-License-Identifier: Apache-2.0
#include "eval/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

#include "base/error.h"
#include "base/regular_file.h"

namespace ridgeline {
namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    Check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void Add(std::string_view bytes) {
    Check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }

  std::string Hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> value{};
    unsigned int size = 0;
    Check(EVP_DigestFinal_ex(context_.get(), value.data(), &size) == 1);
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex;
    for (unsigned int i = 0; i < size; ++i) {
      hex += kDigits[value[i] >> 4];
      hex += kDigits[value[i] & 15];
    }
    return hex;
  }

 private:
  static void Check(bool ok) {
    if (!ok) throw std::runtime_error("SHA-256 of libcrypto failed");
  }

  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

}  // namespace

std::string Sha256Of(std::string_view bytes) {
  Digest digest;
  digest.Add(bytes);
  return digest.Hex();
}

std::string Sha256OfFile(const std::filesystem::path& path) {
  RequireRegularFile(path, "an existing file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string(), "", "no readable file", "an existing file");
  Digest digest;
  std::vector<char> block(1 << 20);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) ||
         stream.gcount() > 0) {
    digest.Add({block.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (stream.bad()) throw InputError(path.string(), "", "a failed read", "a file that can be read");
  return digest.Hex();
}

}  // namespace ridgeline

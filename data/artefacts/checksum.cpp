#include "flexspline/data/checksum.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

struct Sha256::State {
  State() : context(EVP_MD_CTX_new()) {
    expects(context != nullptr && EVP_DigestInit_ex(context, EVP_sha256(), nullptr) == 1,
            "OpenSSL offers SHA-256");
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { EVP_MD_CTX_free(context); }

  EVP_MD_CTX* context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::string_view bytes) {
  expects(EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()) == 1,
          "a checksum is still open when bytes are added");
}

std::string Sha256::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  expects(EVP_DigestFinal_ex(state_->context, digest.data(), &size) == 1,
          "a checksum is finished once");
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.hex();
}

}  // namespace flexspline::data

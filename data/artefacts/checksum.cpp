#include "flexspline/data/checksum.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <vector>

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

Result<void> Sha256::add_file(const std::filesystem::path& file) {
  const auto not_read = [&](const std::string& why) {
    return failure(ErrorCode::input_missing, "cannot read " + file.string() + why,
                   "check the path and its permissions");
  };
  std::error_code unknown;
  if (std::filesystem::exists(file, unknown) && !std::filesystem::is_regular_file(file, unknown)) {
    return not_read(": it is no regular file");
  }
  std::vector<char> piece(std::size_t{1} << 20U);
  std::ifstream stream(file, std::ios::binary);
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())) ||
         stream.gcount() > 0) {
    add({piece.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (stream.bad() || !stream.eof()) return not_read("");
  return {};
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

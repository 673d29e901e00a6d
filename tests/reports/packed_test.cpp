#include "packed.hpp"

#include <array>

#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <zlib.h>

namespace flexspline::reports {
namespace {

/// What a browser does with it: RFC 4648, then RFC 1952.
std::string unpacked(const std::string& letters) {
  std::string bytes(letters.size(), '\0');
  const int length = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                     reinterpret_cast<const unsigned char*>(letters.data()),
                                     static_cast<int>(letters.size()));
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 16 + MAX_WBITS), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(length);
  std::string text;
  std::array<char, 4096> piece{};
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = piece.size();
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(piece.data(), piece.size() - stream.avail_out);
  }
  EXPECT_EQ(state, Z_STREAM_END);
  inflateEnd(&stream);
  return text;
}

TEST(Packed, ComesBackAndCannotEndAScript) {
  std::string series = "{\"y\":[";
  for (int i = 0; i < 20000; ++i) series += std::to_string(i % 997) + ".25,";
  series += "0]} </script> g\u207b\u00b9";
  for (const std::string& text : {std::string(), std::string("{}"), series}) {
    const std::string letters = packed(text);
    EXPECT_EQ(unpacked(letters), text);
    EXPECT_EQ(letters.find('<'), std::string::npos);
    EXPECT_EQ(letters, packed(text));
  }
  EXPECT_LT(packed(series).size(), series.size() / 3);
}

}  // namespace
}  // namespace flexspline::reports

// Bytes in fixed layouts, and their SHA-256 and HMAC-SHA-256.
//
//   Digest d = sha256(Bytes{}.integer(1).text("rack").bytes());
//
// Integers are big-endian, reals their IEEE-754 binary64 bits as such an integer, texts their
// length as 8 bytes and their bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "server/storage/records.hpp"

namespace poolhall::match {

using storage::Digest;

class Bytes {
 public:
  template <class Unsigned>
  Bytes& fixed(Unsigned value) {
    for (int shift = 8 * (static_cast<int>(sizeof(Unsigned)) - 1); shift >= 0; shift -= 8)
      bytes_.push_back(static_cast<std::uint8_t>(std::uint64_t{value} >> shift));
    return *this;
  }
  Bytes& integer(std::int64_t value) { return fixed(static_cast<std::uint64_t>(value)); }
  Bytes& real(double value);
  Bytes& text(std::string_view text);
  Bytes& raw(std::span<const std::uint8_t> bytes);
  // 1 if there is something, else 0; the value is the caller's to add.
  Bytes& presence(bool there) { return fixed(static_cast<std::uint8_t>(there)); }

  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

[[nodiscard]] Digest sha256(std::span<const std::uint8_t> bytes);
[[nodiscard]] Digest hmac_sha256(std::span<const std::uint8_t> key,
                                 std::span<const std::uint8_t> message);

}  // namespace poolhall::match

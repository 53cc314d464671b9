#include "clients/cpp/token.hpp"

#include <random>
#include <string_view>

namespace poolhall::client {

protocol::Hex256 random_token() {
  constexpr std::string_view digits = "0123456789abcdef";
  constexpr std::size_t length = 64;
  std::random_device system;  // getrandom or rdrand in libstdc++
  protocol::Hex256 token;
  while (token.text.size() < length) {
    auto bits = system();
    for (int i = 0; i < 8; ++i) {
      token.text.push_back(digits[bits & 15U]);
      bits >>= 4U;
    }
  }
  return token;
}

}  // namespace poolhall::client

#include "server/web/gzip.hpp"

#include <algorithm>
#include <array>
#include <boost/beast/zlib/deflate_stream.hpp>
#include <boost/crc.hpp>
#include <cctype>
#include <cstdint>

namespace poolhall::web {

namespace zlib = boost::beast::zlib;

namespace {

constexpr int level = 4;
constexpr int window_bits = 15;
constexpr int memory_level = 8;
// Magic, deflate, no flags, no time, no hint, an unknown system.
constexpr std::array<char, 10> header{'\x1f', '\x8b', 8, 0, 0, 0, 0, 0, 0, '\xff'};

std::string lower(std::string_view text) {
  std::string small{text};
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

void append_little_endian(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    out += static_cast<char>(value >> shift & 0xffU);
  }
}

// "gzip;q=0.5" is one of "a, gzip;q=0.5"; q=0 forbids.
bool allows(std::string_view coding) {
  const std::string_view name = coding.substr(0, coding.find(';'));
  if (name != "gzip" && name != "x-gzip" && name != "*") {
    return false;
  }
  const auto q = coding.find("q=");
  return q == std::string_view::npos ||
         coding.find_first_of("123456789", q) != std::string_view::npos;
}

}  // namespace

bool accepts_gzip(std::string_view accept_encoding) {
  std::string text = lower(accept_encoding);
  std::erase(text, ' ');
  std::string_view rest{text};
  while (!rest.empty()) {
    const auto end = std::min(rest.find(','), rest.size());
    if (allows(rest.substr(0, end))) {
      return true;
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

std::string gzip(std::string_view text) {
  zlib::deflate_stream deflate;
  deflate.reset(level, window_bits, memory_level, zlib::Strategy::normal);
  std::string out(header.begin(), header.end());
  out.resize(header.size() + deflate.upper_bound(text.size()));
  zlib::z_params state;
  state.next_in = text.data();
  state.avail_in = text.size();
  state.next_out = out.data() + header.size();
  state.avail_out = out.size() - header.size();
  boost::system::error_code error;
  deflate.write(state, zlib::Flush::finish, error);  // ends with end_of_stream: there is room
  out.resize(header.size() + state.total_out);
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  append_little_endian(out, crc.checksum());
  append_little_endian(out, static_cast<std::uint32_t>(text.size()));
  return out;
}

}  // namespace poolhall::web

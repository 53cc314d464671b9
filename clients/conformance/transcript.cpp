#include "clients/conformance/transcript.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "clients/conformance/verdict.hpp"

namespace poolhall::conformance {
namespace {

constexpr std::size_t kept_lines = 40;
constexpr std::size_t shown_bytes = 360;

// Cut between two characters of UTF-8.
std::string shortened(std::string_view line) {
  if (line.size() <= shown_bytes) {
    return std::string(line);
  }
  std::size_t end = shown_bytes;
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U) {
    --end;
  }
  return std::string(line.substr(0, end)) + "... (" + std::to_string(line.size()) + " bytes)";
}

}  // namespace

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "PASS";
    case Verdict::warning:
      return "WARN";
    case Verdict::failure:
      return "FAIL";
    case Verdict::not_reached:
      return "NOT REACHED";
  }
  return "";
}

void Transcript::add(std::string_view mark, std::string_view line) {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
  std::array<char, 32> time{};
  std::snprintf(time.data(), time.size(), "%7.3f ", passed.count());
  while (line.ends_with('\n')) {
    line.remove_suffix(1);
  }
  lines_.push_back(time.data() + std::string(mark) + shortened(line));
  if (lines_.size() > kept_lines) {
    lines_.pop_front();
  }
}

std::vector<std::string> Transcript::tail(std::size_t count) const {
  const auto kept = static_cast<std::ptrdiff_t>(std::min(count, lines_.size()));
  return {lines_.end() - kept, lines_.end()};
}

}  // namespace poolhall::conformance

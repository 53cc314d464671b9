#include "protocol/framing.hpp"

#include <cassert>

namespace poolhall::protocol {
namespace {

constexpr std::size_t kept_bytes = 1024;

}  // namespace

LineSplitter::LineSplitter(std::size_t limit) : limit_(limit) {
  assert(limit > 0);
}

void LineSplitter::set_limit(std::size_t limit) {
  assert(limit > 0);
  limit_ = limit;
}

bool LineSplitter::inside_line() const {
  return skipping_ || (!pending_.empty() && !returned_pending_);
}

LineSplitter::Step LineSplitter::next(std::string_view chunk) {
  if (returned_pending_) {
    // Thousands of idle connections must not keep the memory of their longest line.
    if (pending_.capacity() > kept_bytes) {
      pending_ = std::string();
    }
    pending_.clear();
    returned_pending_ = false;
  }
  const std::size_t end = chunk.find('\n');
  if (end == std::string_view::npos) {
    return grow(chunk);
  }
  return complete(chunk.substr(0, end), chunk.substr(end + 1));
}

LineSplitter::Step LineSplitter::grow(std::string_view tail) {
  if (skipping_) {
    return {};
  }
  // One byte more than the limit may be the "\r" of a line that just fits.
  if (pending_.size() + tail.size() > limit_ + 1) {
    skipping_ = true;
    pending_ = std::string();
    return {Kind::too_long, {}, {}};
  }
  pending_ += tail;
  return {};
}

LineSplitter::Step LineSplitter::complete(std::string_view tail, std::string_view rest) {
  if (skipping_) {
    skipping_ = false;
    return rest.empty() ? Step{} : next(rest);
  }
  if (pending_.size() + tail.size() > limit_ + 1) {
    pending_ = std::string();
    return {Kind::too_long, {}, rest};
  }
  std::string_view line = tail;
  if (!pending_.empty()) {
    pending_ += tail;
    returned_pending_ = true;
    line = pending_;
  }
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  if (line.size() > limit_) {
    return {Kind::too_long, {}, rest};
  }
  return {Kind::line, line, rest};
}

}  // namespace poolhall::protocol

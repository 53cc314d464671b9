#include "server/storage/turn_texts.hpp"

#include <zstd.h>

#include <array>
#include <memory>
#include <new>

namespace poolhall::storage {
namespace {

// The next ones take longer and save nothing on texts of this kind (measured: 3.2 times less with 1
// and 3.1 with 3).
constexpr int level = 1;
// A turn has some kilobytes, a break of the longest log some hundred.
constexpr unsigned long long longest = 256ULL << 20U;

struct Free {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

// One for a thread: to make one takes longer than to use it.
ZSTD_CCtx* context() {
  thread_local const std::unique_ptr<ZSTD_CCtx, Free> own(ZSTD_createCCtx());
  if (!own)
    throw std::bad_alloc();
  return own.get();
}

bool is_line(std::string_view text) {
  return text.find('\n') == std::string_view::npos;
}

std::optional<std::string> unpacked(std::string_view packed) {
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size > longest)  // so are the codes of errors
    return std::nullopt;
  std::string text(size, '\0');
  if (ZSTD_decompress(text.data(), text.size(), packed.data(), packed.size()) != text.size())
    return std::nullopt;
  return text;
}

}  // namespace

std::optional<std::string> packed_texts(const TurnRecord& turn) {
  if (turn.ruling && turn.ruling->empty())
    return std::nullopt;
  const std::array<std::string_view, 4> texts{
      turn.state_before, turn.state_after,
      turn.ruling ? std::string_view(*turn.ruling) : std::string_view(),
      turn.shot ? std::string_view(turn.shot->events) : std::string_view()};
  std::string lines;
  for (const std::string_view text : texts) {
    if (!is_line(text))
      return std::nullopt;
    lines += text;
    lines += '\n';
  }
  std::string packed(ZSTD_compressBound(lines.size()), '\0');
  const std::size_t size =
      ZSTD_compressCCtx(context(), packed.data(), packed.size(), lines.data(), lines.size(), level);
  if (ZSTD_isError(size) != 0)
    throw std::bad_alloc();  // nothing else can go wrong
  packed.resize(size);
  return packed;
}

bool unpack_texts(std::string_view packed, TurnRecord& turn) {
  const std::optional<std::string> lines = unpacked(packed);
  if (!lines)
    return false;
  std::array<std::string, 4> texts;
  std::string_view rest = *lines;
  for (std::string& text : texts) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos)
      return false;
    text = rest.substr(0, end);
    rest.remove_prefix(end + 1);
  }
  if (!rest.empty() || (!turn.shot && !texts[3].empty()))
    return false;
  turn.state_before = std::move(texts[0]);
  turn.state_after = std::move(texts[1]);
  turn.ruling = texts[2].empty() ? std::nullopt : std::optional(std::move(texts[2]));
  if (turn.shot)
    turn.shot->events = std::move(texts[3]);
  return true;
}

}  // namespace poolhall::storage

// libFuzzer's door to one target, which POOLHALL_FUZZ_TARGET names.
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace poolhall::fuzz {
void POOLHALL_FUZZ_TARGET(std::string_view input);
}  // namespace poolhall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  poolhall::fuzz::POOLHALL_FUZZ_TARGET(std::string_view(reinterpret_cast<const char*>(data), size));
  return 0;
}

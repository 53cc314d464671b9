#include "server/meter/work_meter.hpp"

#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>

namespace poolhall::meter {
namespace {

constexpr std::int64_t not_timed = -1;
// A prime: no rhythm of the server's keeps in step with it.
constexpr std::uint8_t one_in = 7;

constexpr std::array<std::string_view, area_count> names{"json_in", "json_out",  "physics",
                                                         "rules",   "checksums", "database",
                                                         "commits", "receiving", "sending"};

std::array<std::atomic<std::int64_t>, area_count> totals{};  // ns
thread_local std::array<std::uint8_t, area_count> passes{};

std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

std::string_view name(Area area) {
  return names[static_cast<std::size_t>(area)];
}

Metered::Metered(Area area) : area_(area), began_(not_timed) {
  std::uint8_t& pass = passes[static_cast<std::size_t>(area)];
  if (++pass == one_in) {
    pass = 0;
    began_ = clock_ns(CLOCK_THREAD_CPUTIME_ID);
  }
}

Metered::~Metered() {
  if (began_ != not_timed) {
    const std::int64_t took = clock_ns(CLOCK_THREAD_CPUTIME_ID) - began_;
    totals[static_cast<std::size_t>(area_)].fetch_add(one_in * took, std::memory_order_relaxed);
  }
}

std::array<Nanoseconds, area_count> work_times() {
  std::array<Nanoseconds, area_count> times{};
  for (std::size_t i = 0; i < area_count; ++i) {
    times[i] = Nanoseconds{totals[i].load(std::memory_order_relaxed)};
  }
  return times;
}

Nanoseconds process_time() {
  return Nanoseconds{clock_ns(CLOCK_PROCESS_CPUTIME_ID)};
}

std::uint64_t resident_bytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) {
    return 0;
  }
  unsigned long long whole = 0;
  unsigned long long resident = 0;
  const int read = std::fscanf(file, "%llu %llu", &whole, &resident);
  std::fclose(file);
  return read == 2 ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace poolhall::meter

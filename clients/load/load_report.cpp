// What a load found, for people and for programs.
#include <array>
#include <cstdio>
#include <utility>

#include "clients/load/load_run.hpp"
#include "protocol/json_writer.hpp"

namespace poolhall::load {
namespace {

constexpr std::array<std::pair<const char*, double>, 5> shares{
    {{"p50", 0.5}, {"p90", 0.9}, {"p99", 0.99}, {"p99.9", 0.999}, {"max", 1}}};

double ms(Latencies::Duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

void write_counts(protocol::JsonWriter& out, std::string_view key,
                  const std::map<std::string, std::uint64_t>& counts) {
  out.key(key).begin_object();
  for (const auto& [code, count] : counts) {
    out.key(code).integer(count);
  }
  out.end_object();
}

}  // namespace

std::string text_of(LoadReport& report) {
  std::string text;
  for (const std::string& line : report.raised) {
    text += "raised: " + line + "\n";
  }
  if (report.failure) {
    return text + "no figures: " + *report.failure + "\n";
  }
  text += formatted("%.0f shots/s (%llu shots and %llu answers in %.1f s), %llu games ended\n",
                    static_cast<double>(report.shots) / report.seconds,
                    static_cast<unsigned long long>(report.shots),
                    static_cast<unsigned long long>(report.answers), report.seconds,
                    static_cast<unsigned long long>(report.games_over));
  text += "latency, ms:";
  for (const auto& [name, share] : shares) {
    text += formatted("  %s %.2f", name, ms(report.latencies.share_below(share)));
  }
  text += formatted("  (%zu, %llu of them unanswered at the end)\n", report.latencies.size(),
                    static_cast<unsigned long long>(report.unanswered));
  const double shots = static_cast<double>(std::max<std::uint64_t>(report.shots, 1));
  text += formatted("bytes on the wire a shot: %.0f to the agents, %.0f from them\n",
                    static_cast<double>(report.bytes_in) / shots,
                    static_cast<double>(report.bytes_out) / shots);
  for (const auto& [code, count] : report.refusals) {
    text += "refused as it should be: " + code + " " + std::to_string(count) + "\n";
  }
  for (const auto& [code, count] : report.errors) {
    text += "error: " + code + " " + std::to_string(count) + "\n";
  }
  return text + (report.errors.empty() ? "errors: none\n" : "");
}

std::string json_of(LoadReport& report) {
  protocol::JsonWriter out;
  out.begin_object().key("seconds").number(report.seconds).key("shots").integer(report.shots);
  out.key("answers").integer(report.answers).key("games_over").integer(report.games_over);
  out.key("unanswered").integer(report.unanswered).key("bytes_in").integer(report.bytes_in);
  out.key("bytes_out").integer(report.bytes_out).key("latency_ms").begin_object();
  for (const auto& [name, share] : shares) {
    out.key(name).number(ms(report.latencies.share_below(share)));
  }
  out.end_object();
  write_counts(out, "refusals", report.refusals);
  write_counts(out, "errors", report.errors);
  out.key("raised").begin_array();
  for (const std::string& line : report.raised) {
    out.string(line);
  }
  out.end_array().key("failure");
  out.string_or_null(report.failure);
  out.end_object();
  return std::move(out).text();
}

}  // namespace poolhall::load

// A run's results for people and for programs.
#include <algorithm>

#include "clients/conformance/run.hpp"
#include "protocol/json_writer.hpp"

namespace poolhall::conformance {
namespace {

constexpr std::size_t verdict_width = 12;
constexpr std::size_t name_width = 24;

std::string padded(std::string_view text, std::size_t width) {
  std::string cell(text);
  cell.resize(std::max(width, cell.size() + 1), ' ');
  return cell;
}

}  // namespace

std::string text_of(const Report& report) {
  std::string text;
  for (const Result& result : report.results) {
    const Outcome& outcome = result.outcome;
    text += padded(name(outcome.verdict), verdict_width) + padded(result.info.name, name_width) +
            std::string(result.info.demand) + "\n";
    if (!outcome.why.empty()) {
      text += std::string(verdict_width, ' ') + outcome.why + "\n";
    }
    if (outcome.verdict == Verdict::failure || outcome.verdict == Verdict::warning) {
      text += std::string(verdict_width, ' ') + "protocol/README.md, \"" +
              std::string(result.info.section) + "\"; what was said:\n";
      for (const std::string& line : outcome.lines) {
        text += std::string(verdict_width, ' ') + "  " + line + "\n";
      }
    }
  }
  return text + std::to_string(report.count(Verdict::pass)) + " passed, " +
         std::to_string(report.count(Verdict::warning)) + " warned, " +
         std::to_string(report.count(Verdict::failure)) + " failed, " +
         std::to_string(report.count(Verdict::not_reached)) + " not reached\n";
}

std::string json_of(const Report& report) {
  protocol::JsonWriter out;
  out.begin_object().key("checks").begin_array();
  for (const Result& result : report.results) {
    out.begin_object().key("name").string(result.info.name);
    out.key("demand").string(result.info.demand);
    out.key("section").string(result.info.section);
    out.key("verdict").string(name(result.outcome.verdict));
    out.key("why").string(result.outcome.why);
    out.key("lines").begin_array();
    for (const std::string& line : result.outcome.lines) {
      out.string(line);
    }
    out.end_array().end_object();
  }
  out.end_array();
  out.key("passed").integer(report.count(Verdict::pass));
  out.key("warned").integer(report.count(Verdict::warning));
  out.key("failed").integer(report.count(Verdict::failure));
  out.key("not_reached").integer(report.count(Verdict::not_reached)).end_object();
  return std::move(out).text();
}

}  // namespace poolhall::conformance

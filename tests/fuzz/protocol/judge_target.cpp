// What `poolhall judge` is given, fuzzed.
#include <string>

#include "protocol/json_node.hpp"
#include "protocol/judge_document.hpp"
#include "tests/fuzz/protocol/demand.hpp"
#include "tests/fuzz/protocol/protocol_targets.hpp"

namespace poolhall::fuzz {

void judge(std::string_view input) {
  const auto answer = protocol::judge_document(input);
  if (!answer) {
    demand(!answer.error().reason.empty(), "an error has a reason");
    return;
  }
  const auto parsed = protocol::parse_json(*answer, protocol::document_bounds);
  demand(parsed.has_value(), "the answer is JSON");
  const protocol::JsonValue* state = parsed->member("state");
  demand(state != nullptr, "the answer has the next state");
  // The next state is one that judge itself accepts, on the same table.
  const bool standard = input.find("\"table\"") == std::string_view::npos &&
                        input.find("\"physics\"") == std::string_view::npos;
  if (standard && state->member("result")->is_null()) {
    const std::string again =
        R"({"lost_turn":"too_many_refusals","state":)" + protocol::canonical_text(*state) + "}";
    demand(protocol::judge_document(again).has_value(), "the next state is possible");
  }
}

}  // namespace poolhall::fuzz

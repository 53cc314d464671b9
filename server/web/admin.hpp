// The host's calls over HTTP: /api/admin/..., each with the admin token in the header
// `Authorization: Bearer TOKEN` and nowhere else. What a call does is somebody else's business.
//
//   Admin admin{token, calls};
//   if (Admin::is_for(path)) admin.answer({path, authorization, body}, then);
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "server/storage/records.hpp"
#include "server/web/pages.hpp"

namespace poolhall::web {

using Then = std::function<void(Page)>;

struct AdminRequest {
  std::string path;
  std::string authorization;  // the header's value
  std::string body;
};

// Each is called where `answer` is, and calls `then` once, now or later.
struct HostCalls {
  enum class Change : std::uint8_t { start, pause, resume, abort };
  // From the text of a tournament file.
  std::function<void(const std::string& toml, Then then)> create_tournament;
  std::function<void(const std::string& id, Change change, Then then)> change_tournament;
  enum class EntryChange : std::uint8_t { enter, withdraw };
  std::function<void(const std::string& id, EntryChange change, const std::string& agent,
                     Then then)>
      change_entry;
  std::function<void(const std::string& name, Then then)> add_agent;
  std::function<void(std::int64_t game, Then then)> void_game;
};

class Admin {
 public:
  // Without a token every call is refused.
  Admin(const std::optional<std::string>& token, HostCalls calls);

  [[nodiscard]] static bool is_for(std::string_view path);
  void answer(const AdminRequest& request, const Then& then) const;

 private:
  // Whether the header has the token: compared in constant time, never repeated.
  [[nodiscard]] bool is_authorized(std::string_view authorization) const;
  void tournament_call(const AdminRequest& request, std::string_view rest, const Then& then) const;
  void entry_call(const AdminRequest& request, const std::string& id, HostCalls::EntryChange change,
                  const Then& then) const;
  void agent_call(const AdminRequest& request, const Then& then) const;
  void game_call(std::string_view rest, const Then& then) const;

  std::optional<storage::Digest> token_hash_;
  HostCalls calls_;
};

// A tournament's settings given as a JSON object, as the TOML that a file would have.
[[nodiscard]] tl::expected<std::string, std::string> toml_from_json(std::string_view json);

}  // namespace poolhall::web

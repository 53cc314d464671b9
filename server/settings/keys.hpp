// The keys of a settings file as a table: one line each says its name, the kind of its values and
// the member that it sets. Reading, the messages, the defaults and the check against the
// documentation all come from this table.
//
//   Keys<ClockSettings> keys;
//   keys.add("game_seconds", Seconds{1, 86400}, [](auto& s) -> auto& { return s.game; });
//   Expected<void> read = keys.read(node, "", file, settings);
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "server/settings/document.hpp"
#include "server/settings/key_doc.hpp"
#include "server/settings/kinds.hpp"

namespace poolhall::settings {

namespace detail {

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <class T>
concept Duration = requires {
  typename T::period;
};

[[nodiscard]] SettingsError wrong_value(const std::string& file, const Node& node,
                                        const std::string& key, const std::string& expected);
[[nodiscard]] SettingsError unknown_key(const std::string& file, const Member& member,
                                        const std::string& key,
                                        const std::vector<std::string>& known);

// Kinds give the widest type; members may be narrower: the kind's range fits them.
template <class Member, class Value>
void assign(Member& member, const Value& value) {
  if constexpr (IsOptional<Member>::value) {
    assign(member.emplace(), value);
  } else if constexpr (Duration<Member>) {
    member = std::chrono::round<Member>(value);
  } else {
    member = static_cast<Member>(value);
  }
}

template <class Kind>
[[nodiscard]] std::string expected_now(const Kind& kind) {
  if constexpr (requires { kind.expected_now(); }) {
    return kind.expected_now();
  } else {
    return kind.expected();
  }
}

template <class Kind, class Member>
[[nodiscard]] std::optional<std::string> written(const Kind& kind, const Member& member) {
  if constexpr (IsOptional<Member>::value) {
    return member ? written(kind, *member) : std::nullopt;
  } else if constexpr (requires { member.string(); }) {
    return kind.write(member.string());
  } else {
    return kind.write(static_cast<typename Kind::Value>(member));
  }
}

}  // namespace detail

template <class Target>
class Keys {
 public:
  template <class Kind, class Access>
  void add(std::string name, const Kind& kind, Access access) {
    entries_.push_back(
        {std::move(name), kind.expected(), detail::expected_now(kind),
         [kind, access](const Node& node, Target& target) {
           auto value = kind.read(node);
           if (value) {
             detail::assign(access(target), *value);
           }
           return value.has_value();
         },
         [kind, access](const Target& target) { return detail::written(kind, access(target)); }});
  }

  // Sets what the table gives; refuses keys that are not in the list, below `prefix` too.
  [[nodiscard]] Expected<void> read(const Node& table, const std::string& file,
                                    Target& target) const {
    return read_below(table, "", file, target);
  }

  [[nodiscard]] std::vector<KeyDoc> documentation() const {
    std::vector<KeyDoc> docs;
    for (const Entry& entry : entries_) {
      docs.push_back({entry.name, entry.expected, entry.write(Target{})});
    }
    return docs;
  }

  // Members of this name are read by somebody else.
  void leave(std::string name) { left_.push_back(std::move(name)); }

 private:
  struct Entry {
    std::string name;
    std::string expected;      // for the documentation
    std::string expected_now;  // for a refusal
    std::function<bool(const Node&, Target&)> read;
    std::function<std::optional<std::string>(const Target&)> write;
  };

  [[nodiscard]] Expected<void> read_below(const Node& table, const std::string& prefix,
                                          const std::string& file, Target& target) const {
    for (const Member& member : std::get<Table>(table.value)) {
      const std::string name = prefix + member.key;
      if (std::find(left_.begin(), left_.end(), name) != left_.end()) {
        continue;
      }
      if (auto done = read_member(member, name, file, target); !done) {
        return done;
      }
    }
    return {};
  }

  [[nodiscard]] Expected<void> read_member(const Member& member, const std::string& name,
                                           const std::string& file, Target& target) const {
    for (const Entry& entry : entries_) {
      if (entry.name == name) {
        if (!entry.read(member.node, target)) {
          return tl::unexpected(detail::wrong_value(file, member.node, name, entry.expected_now));
        }
        return {};
      }
    }
    if (!is_table_name(name)) {
      return tl::unexpected(detail::unknown_key(file, member, name, names()));
    }
    if (!std::holds_alternative<Table>(member.node.value)) {
      return tl::unexpected(detail::wrong_value(file, member.node, name, "a table"));
    }
    return read_below(member.node, name + ".", file, target);
  }

  [[nodiscard]] bool is_table_name(const std::string& name) const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const Entry& entry) { return entry.name.starts_with(name + "."); });
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all = left_;
    for (const Entry& entry : entries_) {
      all.push_back(entry.name);
    }
    return all;
  }

  std::vector<Entry> entries_;
  std::vector<std::string> left_;
};

}  // namespace poolhall::settings

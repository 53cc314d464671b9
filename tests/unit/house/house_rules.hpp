// Which doors of the house are open: for every room the rooms and the third-party libraries whose
// headers it may include.
//
//   std::vector<std::string> wrong = forbidden_includes("rules/eight_ball.cpp", text);
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace poolhall::house {

struct Room {
  std::string path;
  std::vector<std::string> rooms;             // besides itself
  std::vector<std::string> libraries;         // beginnings of what stands between < and >
  std::vector<std::string> source_libraries;  // the same, but not in headers
};

[[nodiscard]] const std::vector<Room>& rooms();

// The room that the file, named from the root, is in; null if it is in none.
[[nodiscard]] const Room* room_of(std::string_view file);

// One line for each include that the file's room does not allow.
[[nodiscard]] std::vector<std::string> forbidden_includes(std::string_view file,
                                                          std::string_view text);

}  // namespace poolhall::house

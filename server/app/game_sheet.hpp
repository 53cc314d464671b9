// A whole game on one sheet: its shots side by side, in their order.
//
//   std::string svg = game_sheet("game 17: Anna against Bob", {{"1 Anna", table_svg(...)}, ...});
#pragma once

#include <string>
#include <vector>

namespace poolhall::app {

struct SheetShot {
  std::string title;
  std::string picture;  // an SVG document, as table_svg makes it
  double width = 0;     // px, of the picture
  double height = 0;
};

[[nodiscard]] std::string game_sheet(const std::string& title, const std::vector<SheetShot>& shots);

}  // namespace poolhall::app

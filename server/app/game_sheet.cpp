#include "server/app/game_sheet.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace poolhall::app {
namespace {

constexpr std::size_t columns = 5;
constexpr double shrunk = 0.5;
constexpr double heading = 40;  // px
constexpr double caption = 26;  // px, above each shot
constexpr double gap = 12;      // px

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '&':
        out += "&amp;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace

std::string game_sheet(const std::string& title, const std::vector<SheetShot>& shots) {
  double width = 0;
  double height = 0;
  for (const SheetShot& shot : shots) {
    width = std::max(width, shrunk * shot.width + gap);
    height = std::max(height, shrunk * shot.height + caption + gap);
  }
  const std::size_t across = std::min(columns, std::max<std::size_t>(shots.size(), 1));
  const std::size_t rows = (shots.size() + columns - 1) / columns;
  std::string svg =
      fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{:.0f}" height="{:.0f}" )"
                  R"(font-family="sans-serif"><rect width="100%" height="100%" fill="#fff"/>)"
                  R"(<text x="{}" y="26" font-size="20">{}</text>)"
                  "\n",
                  gap + static_cast<double>(across) * width,
                  heading + static_cast<double>(rows) * height, gap, escaped(title));
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const double x = gap + static_cast<double>(i % columns) * width;
    const std::size_t row = i / columns;
    const double y = heading + static_cast<double>(row) * height;
    svg += fmt::format(R"svg(<text x="{0:.0f}" y="{1:.0f}" font-size="13">{2}</text>)svg"
                       R"svg(<g transform="translate({0:.0f} {3:.0f}) scale({4})">{5}</g>)svg"
                       "\n",
                       x, y + caption - 8, escaped(shots[i].title), y + caption, shrunk,
                       shots[i].picture);
  }
  return svg + "</svg>\n";
}

}  // namespace poolhall::app

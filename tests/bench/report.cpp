#include "tests/bench/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace poolhall::bench {

namespace {

std::ofstream opened(const std::filesystem::path& file) {
  if (file.has_parent_path()) {
    std::filesystem::create_directories(file.parent_path());
  }
  std::ofstream out(file);
  if (!out) {
    throw std::runtime_error("cannot write " + file.string());
  }
  return out;
}

std::string escaped_csv(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    if (c == '"') {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string escaped_xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
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

// The drawing's own measures, in SVG user units.
constexpr double plot_left = 80;
constexpr double plot_top = 40;
constexpr double plot_width = 560;
constexpr double plot_height = 400;
constexpr double legend_width = 300;

// Decades of one axis.
struct Axis {
  int low = 0;
  int high = 1;

  [[nodiscard]] double share(double value) const {
    return (std::log10(value) - low) / (high - low);
  }
};

Axis axis_of(const std::vector<PlotSeries>& series, double PlotPoint::*coordinate) {
  double low = INFINITY;
  double high = -INFINITY;
  for (const PlotSeries& s : series) {
    for (const PlotPoint& p : s.points) {
      low = std::min(low, std::log10(p.*coordinate));
      high = std::max(high, std::log10(p.*coordinate));
    }
  }
  if (!(low <= high)) {
    return {};
  }
  Axis axis{static_cast<int>(std::floor(low)), static_cast<int>(std::ceil(high))};
  if (axis.low == axis.high) {
    ++axis.high;
  }
  return axis;
}

void draw_axes(std::ostream& out, const LogLogPlot& plot, const Axis& x, const Axis& y) {
  out << "<g stroke=\"#ddd\">\n";
  for (int d = x.low; d <= x.high; ++d) {
    const double at = plot_left + plot_width * (d - x.low) / (x.high - x.low);
    out << "<path d=\"M" << at << ' ' << plot_top << "v" << plot_height << "\"/>\n";
  }
  for (int d = y.low; d <= y.high; ++d) {
    const double at = plot_top + plot_height * (y.high - d) / (y.high - y.low);
    out << "<path d=\"M" << plot_left << ' ' << at << "h" << plot_width << "\"/>\n";
  }
  out << "</g>\n<g fill=\"#333\">\n";
  const int every_x = std::max(1, (x.high - x.low) / 8);
  for (int d = x.low; d <= x.high; d += every_x) {
    const double at = plot_left + plot_width * (d - x.low) / (x.high - x.low);
    out << "<text x=\"" << at << "\" y=\"" << plot_top + plot_height + 18
        << "\" text-anchor=\"middle\">1e" << d << "</text>\n";
  }
  const int every_y = std::max(1, (y.high - y.low) / 10);
  for (int d = y.low; d <= y.high; d += every_y) {
    const double at = plot_top + plot_height * (y.high - d) / (y.high - y.low);
    out << "<text x=\"" << plot_left - 8 << "\" y=\"" << at + 4 << "\" text-anchor=\"end\">1e" << d
        << "</text>\n";
  }
  out << "<text x=\"" << plot_left + plot_width / 2 << "\" y=\"" << plot_top + plot_height + 40
      << "\" text-anchor=\"middle\">" << escaped_xml(plot.x_label) << "</text>\n"
      << "<text transform=\"translate(22 " << plot_top + plot_height / 2
      << ") rotate(-90)\" text-anchor=\"middle\">" << escaped_xml(plot.y_label) << "</text>\n"
      << "<text x=\"" << plot_left << "\" y=\"24\" font-weight=\"bold\">" << escaped_xml(plot.title)
      << "</text>\n</g>\n";
}

// The mark of the `index`th series: no two of eight neighbours are alike in shape and colour.
void draw_mark(std::ostream& out, std::size_t index, double x, double y) {
  switch (index % 4) {
    case 0:
      out << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"4\"";
      break;
    case 1:
      out << "<path d=\"M" << x - 4 << ' ' << y - 4 << "h8v8h-8z\"";
      break;
    case 2:
      out << "<path d=\"M" << x << ' ' << y - 5 << "l5 9h-10z\"";
      break;
    default:
      out << "<path d=\"M" << x << ' ' << y - 5 << "l5 5l-5 5l-5 -5z\"";
  }
  // The lower ones would hide those before them.
  out << (index == 0 ? "" : " fill=\"white\" fill-opacity=\"0.5\"") << "/>\n";
}

void draw_series(std::ostream& out, const PlotSeries& series, std::size_t index, const Axis& x,
                 const Axis& y) {
  constexpr std::array<const char*, 10> colours{"#1b6ca8", "#d1495b", "#2e933c", "#8e5ea2",
                                                "#e07a1f", "#00798c", "#6b4226", "#c2185b",
                                                "#5d737e", "#9a8c00"};
  const char* colour = colours[index % colours.size()];
  std::ostringstream line;
  std::ostringstream labels;
  out << "<g stroke=\"" << colour << "\" stroke-width=\"1.5\" fill=\"" << colour << "\">\n";
  for (const PlotPoint& p : series.points) {
    const double px = plot_left + plot_width * x.share(p.x);
    const double py = plot_top + plot_height * (1 - y.share(p.y));
    line << px << ',' << py << ' ';
    draw_mark(out, index, px, py);
    if (!p.label.empty()) {
      labels << "<text x=\"" << px + 14 << "\" y=\"" << py + 4 << "\">" << escaped_xml(p.label)
             << "</text>\n";
    }
  }
  out << "<polyline fill=\"none\" points=\"" << line.str() << "\"/>\n";
  const double legend_y = plot_top + 12 + 20 * static_cast<double>(index);
  const double legend_x = plot_left + plot_width + 20;
  draw_mark(out, index, legend_x, legend_y - 4);
  out << "</g>\n<g fill=\"" << colour << "\" font-size=\"11\">\n"
      << labels.str() << "</g>\n<text x=\"" << legend_x + 12 << "\" y=\"" << legend_y << "\">"
      << escaped_xml(series.name) << "</text>\n";
}

}  // namespace

std::string cell(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits);
  const double size = std::abs(value);
  if (size >= std::pow(10, digits) && size < 1e7) {
    text << std::fixed << std::setprecision(0);
  }
  text << value;
  return text.str();
}

ReportTable::ReportTable(std::string title, std::vector<std::string> columns)
    : title_(std::move(title)), columns_(std::move(columns)) {}

void ReportTable::add(std::vector<std::string> row) {
  row.resize(columns_.size());
  rows_.push_back(std::move(row));
}

void ReportTable::print(std::ostream& out) const {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    std::size_t width = columns_[c].size();
    for (const auto& row : rows_) {
      width = std::max(width, row[c].size());
    }
    widths.push_back(width);
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      out << (c == 0 ? "  " : "   ") << (c == 0 ? std::left : std::right)
          << std::setw(static_cast<int>(widths[c])) << cells[c];
    }
    out << '\n';
  };
  out << title_ << '\n';
  line(columns_);
  for (const auto& row : rows_) {
    line(row);
  }
  out << std::flush;
}

void ReportTable::write_csv(const std::filesystem::path& file) const {
  std::ofstream out = opened(file);
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      out << (c == 0 ? "" : ",") << escaped_csv(cells[c]);
    }
    out << '\n';
  };
  line(columns_);
  for (const auto& row : rows_) {
    line(row);
  }
}

void LogLogPlot::write_svg(const std::filesystem::path& file) const {
  write_panels({*this}, 1, file);
}

void write_panels(const std::vector<LogLogPlot>& plots, std::size_t columns,
                  const std::filesystem::path& file) {
  constexpr double panel_width = plot_left + plot_width + legend_width;
  constexpr double panel_height = plot_top + plot_height + 60;
  std::ofstream out = opened(file);
  const std::size_t rows = (plots.size() + columns - 1) / columns;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "
      << panel_width * static_cast<double>(columns) << ' '
      << panel_height * static_cast<double>(rows)
      << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (std::size_t n = 0; n < plots.size(); ++n) {
    const LogLogPlot& plot = plots[n];
    const Axis x = axis_of(plot.series, &PlotPoint::x);
    const Axis y = axis_of(plot.series, &PlotPoint::y);
    const std::size_t row = n / columns;
    out << "<g transform=\"translate(" << panel_width * static_cast<double>(n % columns) << ' '
        << panel_height * static_cast<double>(row) << ")\">\n";
    draw_axes(out, plot, x, y);
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      draw_series(out, plot.series[i], i, x, y);
    }
    out << "</g>\n";
  }
  out << "</svg>\n";
}

std::vector<double> quantiles(std::vector<double> values, const std::vector<double>& shares) {
  std::sort(values.begin(), values.end());
  std::vector<double> found;
  for (const double q : shares) {
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    found.push_back(values.empty() ? NAN
                                   : values[std::min(values.size() - 1, rank == 0 ? 0 : rank - 1)]);
  }
  return found;
}

double quantile(std::vector<double> values, double q) {
  return quantiles(std::move(values), {q}).front();
}

}  // namespace poolhall::bench

// What a benchmark shows: a table on the terminal, the same as CSV, and a plot as SVG.
//
//   ReportTable table{"speed", {"scene", "median us", "p90 us"}};
//   table.add({"cue + 1", cell(1.02), cell(1.31)});
//   table.print(std::cout);
//   table.write_csv(directory / "speed.csv");
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace poolhall::bench {

// A number with three significant digits, as a benchmark can know it; `digits` for more.
[[nodiscard]] std::string cell(double value, int digits = 3);

class ReportTable {
 public:
  ReportTable(std::string title, std::vector<std::string> columns);

  // One cell a column.
  void add(std::vector<std::string> row);
  void print(std::ostream& out) const;
  // Throws std::runtime_error that names the file if it cannot be written.
  void write_csv(const std::filesystem::path& file) const;

 private:
  std::string title_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

struct PlotPoint {
  double x = 0;
  double y = 0;
  std::string label{};  // written beside it
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  // both coordinates above zero
};

// Both axes logarithmic. The points of a series are joined by a line and have a mark of their own.
struct LogLogPlot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;

  void write_svg(const std::filesystem::path& file) const;
};

// Several plots in one file, row by row.
void write_panels(const std::vector<LogLogPlot>& plots, std::size_t columns,
                  const std::filesystem::path& file);

// The value below which the share `q` of `values` lies (nearest rank); sorts a copy.
[[nodiscard]] double quantile(std::vector<double> values, double q);
// The same for several shares at once.
[[nodiscard]] std::vector<double> quantiles(std::vector<double> values,
                                            const std::vector<double>& shares);

}  // namespace poolhall::bench

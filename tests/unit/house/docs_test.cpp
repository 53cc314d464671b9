// The pages beside the code against the code: links lead somewhere, functions are where a page
// says, and what is to be documented is.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "house_rules.hpp"

// A namespace of its own: some of its names are another file's.
namespace poolhall::house::docs_tests {
namespace {

namespace fs = std::filesystem;

const fs::path house_root = POOLHALL_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Every page of the house; what is built or fetched lies in folders that are left out.
std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(house_root)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".md") {
      found.push_back(entry.path());
    }
    if (!entry.is_directory() || name.starts_with(".") || name.starts_with("build")) {
      continue;
    }
    for (const auto& inner : fs::recursive_directory_iterator(entry.path())) {
      const bool is_fetched = inner.path().string().find("node_modules") != std::string::npos;
      if (inner.path().extension() == ".md" && !is_fetched) {
        found.push_back(inner.path());
      }
    }
  }
  return found;
}

// The first groups of all matches.
std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

TEST(Pages, AreInEveryRoom) {
  std::vector<std::string> folders{"server", "clients",     "config",     "config/tables",
                                   "tests",  "tests/bench", "tests/fault"};
  for (const Room& room : rooms()) {
    folders.push_back(room.path);
  }
  for (const std::string& folder : folders) {
    const bool is_within_another = folder.starts_with("tests/fault/") || folder == "tests/support";
    if (fs::exists(house_root / folder) && !is_within_another) {
      EXPECT_TRUE(fs::exists(house_root / folder / "README.md")) << folder;
    }
  }
}

TEST(Pages, HaveLinksThatLeadSomewhere) {
  const std::regex link(R"(\]\(([^)#\s]+)(?:#[^)]*)?\))");
  std::size_t links = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& target : matches(read(page), link)) {
      if (target.find("://") == std::string::npos) {
        EXPECT_TRUE(fs::exists(page.parent_path() / target))
            << fs::relative(page, house_root).string() << ": " << target;
        ++links;
      }
    }
  }
  EXPECT_GT(links, 40U);
}

// `path/file.cpp`: `Class::function`, `function`
TEST(Architecture, NamesFunctionsWhereTheyAre) {
  const std::string page =
      std::regex_replace(read(house_root / "ARCHITECTURE.md"), std::regex("\\s+"), " ");
  const std::regex step(R"(`([\w/]+/[\w.]+\.(?:cpp|hpp|js))`(:? ?)((?:`[\w:]+`(?:, )?)*))");
  std::size_t functions = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), step), end; it != end; ++it) {
    const std::string file = (*it)[1];
    ASSERT_TRUE(fs::exists(house_root / file)) << file;
    if ((*it)[2].str().empty() || (*it)[2].str()[0] != ':') {
      continue;
    }
    const std::string text = read(house_root / file);
    for (const std::string& name : matches((*it)[3], std::regex("`([\\w:]+)`"))) {
      // Or a method of a class that is written inside it.
      const bool is_there =
          text.find(name) != std::string::npos ||
          text.find(" " + name.substr(name.rfind(':') + 1) + "(") != std::string::npos;
      EXPECT_TRUE(is_there) << file << ": " << name;
      ++functions;
    }
  }
  EXPECT_GT(functions, 30U);
}

TEST(Operations, NamesEveryMetric) {
  const std::string page = read(house_root / "docs/operations.md");
  const std::string source = read(house_root / "server/net/figures.cpp");
  const auto names = matches(source, std::regex(R"re(metric\(out, "([a-z_]+)")re"));
  EXPECT_GT(names.size(), 10U);
  for (const std::string& name : names) {
    EXPECT_NE(page.find("`poolhall_" + name + "`"), std::string::npos) << name;
  }
}

TEST(Operations, NamesEverySubCommand) {
  const std::string page = read(house_root / "docs/operations.md");
  const std::string source = read(house_root / "server/app/commands.hpp");
  const auto names = matches(source, std::regex(R"(add_(\w+)_command\()"));
  EXPECT_GT(names.size(), 10U);
  for (const std::string& name : names) {
    EXPECT_NE(page.find("`poolhall " + name + "`"), std::string::npos) << name;
  }
}

TEST(Storage, NamesEveryFailpoint) {
  const std::string page = read(house_root / "server/storage/README.md");
  std::string source = read(house_root / "server/storage/failpoint.hpp");
  source = source.substr(source.find("enum class Failpoint"));
  source = source.substr(0, source.find("};"));
  const auto names = matches(source, std::regex(R"(\n\s+(\w+),)"));
  EXPECT_GE(names.size(), 5U);
  for (const std::string& name : names) {
    EXPECT_NE(page.find("`" + name + "`"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace poolhall::house::docs_tests

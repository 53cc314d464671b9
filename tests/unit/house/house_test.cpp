// The house as it stands: includes go only through open doors, and no file is too long to read.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "house_rules.hpp"

namespace poolhall::house {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::ptrdiff_t longest_file = 600;  // lines

const std::filesystem::path root = POOLHALL_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Files of code below the folders that hold any, named from the root.
std::vector<std::string> code_files(const std::vector<std::string>& folders) {
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (entry.is_regular_file() && (extension == ".cpp" || extension == ".hpp")) {
        files.push_back(std::filesystem::relative(entry.path(), root).string());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(House, EveryIncludeGoesThroughAnOpenDoor) {
  const auto files = code_files({"physics", "rules", "protocol", "server", "clients"});
  EXPECT_GT(files.size(), 50u);
  for (const std::string& file : files) {
    EXPECT_THAT(forbidden_includes(file, text_of(root / file)), IsEmpty());
  }
}

TEST(House, EveryFileIsInARoom) {
  for (const std::string& file :
       code_files({"physics", "rules", "protocol", "server", "clients"})) {
    EXPECT_NE(room_of(file), nullptr) << file;
  }
}

TEST(House, NoFileIsLongerThanSixHundredLines) {
  for (const std::string& file :
       code_files({"physics", "rules", "protocol", "server", "clients", "tests"})) {
    const std::string text = text_of(root / file);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), longest_file) << file;
  }
}

TEST(HouseRules, ARoomMayNotLookToItsRight) {
  EXPECT_THAT(forbidden_includes("physics/ball.cpp",
                                 "#include \"physics/ball.hpp\"\n"
                                 "#include \"rules/referee.hpp\"\n"),
              ElementsAre("physics/ball.cpp:2: rules/referee.hpp"));
  EXPECT_THAT(forbidden_includes("rules/a.hpp", "  #  include \"protocol/codec.hpp\""),
              ElementsAre("rules/a.hpp:1: protocol/codec.hpp"));
  EXPECT_THAT(
      forbidden_includes("server/tournament/a.cpp", "#include \"server/storage/database.hpp\""),
      testing::SizeIs(1));
  EXPECT_THAT(forbidden_includes("rules/a.cpp", "#include \"physics/ball.hpp\""), IsEmpty());
}

TEST(HouseRules, TheReferencePhysicsIsARoomOfItsOwn) {
  EXPECT_THAT(forbidden_includes("physics/a.cpp", "#include \"physics/reference/real.hpp\""),
              testing::SizeIs(1));
}

TEST(HouseRules, LibrariesStayInTheirRooms) {
  EXPECT_THAT(forbidden_includes("physics/a.cpp",
                                 "#include <vector>\n#include <tl/expected.hpp>\n"
                                 "#include <Random123/philox.h>"),
              IsEmpty());
  for (const char* header :
       {"boost/asio/io_context.hpp", "nlohmann/json.hpp", "sqlite3.h", "zstd.h", "toml++/toml.h",
        "spdlog/spdlog.h", "openssl/evp.h", "unistd.h"}) {
    const std::string line = "#include <" + std::string(header) + ">";
    EXPECT_THAT(forbidden_includes("rules/a.cpp", line), testing::SizeIs(1)) << header;
    EXPECT_THAT(forbidden_includes("server/tournament/a.cpp", line), testing::SizeIs(1)) << header;
  }
}

TEST(HouseRules, JsonIsNotSeenOutsideTheSourcesOfTheProtocol) {
  const char* line = "#include <nlohmann/json.hpp>";
  EXPECT_THAT(forbidden_includes("protocol/a.cpp", line), IsEmpty());
  EXPECT_THAT(forbidden_includes("protocol/a.hpp", line), testing::SizeIs(1));
}

TEST(HouseRules, IncludesAreNamedFromTheRoot) {
  EXPECT_THAT(forbidden_includes("physics/a.cpp", "#include \"ball.hpp\""), testing::SizeIs(1));
}

}  // namespace
}  // namespace poolhall::house

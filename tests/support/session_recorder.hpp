// Writes down what goes over one connection, for tests/support/validate_messages.py: after the
// integration tests every message of every connection is held against the published schemas (the
// test net.every_message_is_valid). Without POOLHALL_SESSIONS, a folder, nothing is written.
//
//   SessionRecorder recorder;
//   recorder.sent(bytes);       // to the server, cut anywhere
//   recorder.received(bytes);   // from it
#pragma once

#include <fstream>
#include <string>
#include <string_view>

namespace poolhall::test_support {

class SessionRecorder {
 public:
  SessionRecorder();
  void sent(std::string_view bytes);
  void received(std::string_view bytes);

 private:
  std::ofstream file_;
  std::string to_server_;  // lines that have begun
  std::string to_agent_;
};

}  // namespace poolhall::test_support

// A server with a page, of whom the host asks something over HTTP.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>

#include "http_client.hpp"
#include "test_server.hpp"
#include "tests/support/temporary_directory.hpp"

namespace poolhall::net_tests {

class AdminFixture : public ::testing::Test {
 protected:
  AdminFixture() {
    std::ofstream(directory_ / "token") << token_ << "\n";
    start();
  }
  // Anew, if it runs: with the tournaments of before.
  void start() {
    server_.reset();
    net::ServerOptions options = test_options(directory_ / "test.db");
    options.settings.http = "127.0.0.1:0";
    options.settings.http_name = "pool.example.org";
    options.settings.admin_token_file = (directory_ / "token").string();
    options.settings.registration = registration_;
    options.settings.max_house_bots = max_house_bots_;
    options.stored_tournaments = net::StoredTournaments::taken_up;
    server_ = std::make_unique<TestServer>(options);
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }
  [[nodiscard]] std::uint16_t http() const { return server_->server().http_endpoint()->port; }
  [[nodiscard]] HttpAnswer post(const std::string& path, const std::string& body = {}) const {
    return http_call(http(), {"POST", "/api/admin/" + path, body, token_});
  }

  const std::string token_ = "a-token-for-this-test-only";
  test_support::TemporaryDirectory directory_;
  std::string registration_ = "open";
  std::uint32_t max_house_bots_ = 16;
  std::unique_ptr<TestServer> server_;
};

}  // namespace poolhall::net_tests

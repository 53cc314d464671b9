#include "server/net/visitors.hpp"

#include <gtest/gtest.h>

namespace poolhall::net {
namespace {

using boost::asio::ip::make_address;
using std::chrono::minutes;
using std::chrono::seconds;

class VisitorsTest : public testing::Test {
 protected:
  VisitorsTest() { limits_.connections = 1'000'000; }

  std::optional<protocol::Error> arrives(const std::string& from) {
    return visitors_.arrives(make_address(from), now_);
  }
  // As many as come in until one is refused; all leave at once.
  int arrivals_at_once(const std::string& from) {
    int count = 0;
    while (!arrives(from)) {
      visitors_.leaves(make_address(from));
      ++count;
    }
    return count;
  }
  int registrations_at_once(const std::string& from) {
    int count = 0;
    while (!visitors_.registers(make_address(from), now_)) {
      ++count;
    }
    return count;
  }

  protocol::Limits limits_;
  Visitors visitors_{limits_};
  SteadyTime now_{minutes{100}};
};

TEST_F(VisitorsTest, one_address_has_a_bounded_number_of_connections) {
  for (int i = 0; i < 32; ++i) {
    EXPECT_FALSE(arrives("10.0.0.1"));
  }
  EXPECT_EQ(arrives("10.0.0.1")->code, protocol::ErrorCode::server_full);
  EXPECT_FALSE(arrives("10.0.0.2"));
  visitors_.leaves(make_address("10.0.0.1"));
  EXPECT_FALSE(arrives("10.0.0.1"));
}

TEST_F(VisitorsTest, the_first_64_bits_of_an_ipv6_address_are_one_visitor) {
  for (int i = 0; i < 32; ++i) {
    EXPECT_FALSE(arrives("2001:db8::" + std::to_string(i)));
  }
  EXPECT_TRUE(arrives("2001:db8::ffff:1"));
  EXPECT_FALSE(arrives("2001:db8:0:1::1"));
}

TEST_F(VisitorsTest, an_ipv4_address_is_the_same_on_an_ipv6_socket) {
  for (int i = 0; i < 32; ++i) {
    EXPECT_FALSE(arrives("::ffff:10.0.0.1"));
  }
  EXPECT_TRUE(arrives("10.0.0.1"));
  EXPECT_FALSE(arrives("::ffff:10.0.0.2"));
}

TEST_F(VisitorsTest, arrivals_have_a_rate) {
  EXPECT_EQ(arrivals_at_once("10.0.0.1"), 4 * 32);
  EXPECT_EQ(arrives("10.0.0.1")->code, protocol::ErrorCode::rate_limited);
  EXPECT_FALSE(arrives("10.0.0.2"));
  now_ += seconds{1};
  EXPECT_EQ(arrivals_at_once("10.0.0.1"), 32);
}

TEST_F(VisitorsTest, new_agents_have_a_rate) {
  EXPECT_EQ(registrations_at_once("10.0.0.1"), 8 * 32);
  now_ += seconds{60};
  EXPECT_GT(registrations_at_once("10.0.0.1"), 16);
  EXPECT_GT(registrations_at_once("10.0.0.2"), 0);
}

TEST_F(VisitorsTest, who_may_have_more_connections_may_come_faster) {
  limits_.connections_per_address = 1'000;
  EXPECT_EQ(arrivals_at_once("10.0.0.1"), 4'000);
}

TEST_F(VisitorsTest, all_together_are_bounded) {
  limits_.connections = 2;
  EXPECT_FALSE(arrives("10.0.0.1"));
  EXPECT_FALSE(arrives("10.0.0.2"));
  EXPECT_EQ(arrives("10.0.0.3")->code, protocol::ErrorCode::server_full);
}

TEST_F(VisitorsTest, who_has_left_is_forgotten_but_for_what_it_has_used_up) {
  EXPECT_GT(registrations_at_once("9.0.0.1"), 0);
  for (int i = 0; i < 5'000; ++i) {
    const std::string from = "10.0." + std::to_string(i / 250) + '.' + std::to_string(i % 250);
    ASSERT_FALSE(arrives(from));
    visitors_.leaves(make_address(from));
  }
  now_ += seconds{60};
  ASSERT_FALSE(arrives("11.0.0.1"));
  EXPECT_EQ(visitors_.known(), 2U);
  EXPECT_LT(registrations_at_once("9.0.0.1"), 8 * 32);
}

}  // namespace
}  // namespace poolhall::net

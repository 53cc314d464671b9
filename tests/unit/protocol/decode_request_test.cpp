#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "protocol/codec.hpp"

namespace poolhall::protocol {
namespace {

const Limits default_limits;

std::string line(std::string_view method, std::string_view params) {
  return R"({"jsonrpc":"2.0","id":1,"method":")" + std::string(method) + R"(","params":)" +
         std::string(params) + "}";
}

template <class Wanted>
Wanted decoded(std::string_view method, std::string_view params) {
  const auto incoming = decode_request(line(method, params), default_limits);
  if (!incoming) {
    ADD_FAILURE() << incoming.error().error.field << ": " << incoming.error().error.reason;
    return {};
  }
  const auto* request = std::get_if<Wanted>(&incoming->request);
  EXPECT_NE(request, nullptr);
  return request == nullptr ? Wanted{} : *request;
}

Error refused_line(std::string_view text) {
  const auto incoming = decode_request(text, default_limits);
  EXPECT_FALSE(incoming) << text;
  return incoming ? Error{} : incoming.error().error;
}

Error refused(std::string_view method, std::string_view params) {
  return refused_line(line(method, params));
}

constexpr std::string_view good_shot =
    R"({"game":3,"turn":2,"shot_id":"s","params":{"a":1,"b":-2,"theta":5,"phi":90.5,"v":3}})";

std::string shot_with(std::string_view key, std::string_view value) {
  std::string text(good_shot);
  text.pop_back();
  return text + ",\"" + std::string(key) + "\":" + std::string(value) + "}";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// ---- The frame ----

TEST(DecodeRequest, KeepsTheIdAsCanonicalText) {
  const auto id = [](std::string_view json) {
    return decode_request(
               R"({"jsonrpc":"2.0","method":"ping","params":{},"id":)" + std::string(json) + "}",
               default_limits)
        ->id->json;
  };
  EXPECT_EQ(id("7"), "7");
  EXPECT_EQ(id(R"("\u0061b")"), R"("ab")");
  EXPECT_EQ(id("null"), "null");
  EXPECT_EQ(id("-1.5"), "-1.5");
}

TEST(DecodeRequest, LetsOnlyLagGoWithoutAnId) {
  const auto lag =
      decode_request(R"({"jsonrpc":"2.0","method":"lag","params":{"t":5}})", default_limits);
  ASSERT_TRUE(lag);
  EXPECT_FALSE(lag->id);
  EXPECT_EQ(std::get<Lag>(lag->request).t, 5);
  const Error error = refused_line(R"({"jsonrpc":"2.0","method":"ack","params":{"game":1}})");
  EXPECT_EQ(error.code, ErrorCode::invalid_request);
  EXPECT_EQ(error.field, "/id");
}

TEST(DecodeRequest, RefusesBatchesAndWhatIsNoObject) {
  EXPECT_EQ(refused_line("[]").code, ErrorCode::invalid_request);
  EXPECT_NE(refused_line("[{},{}]").reason.find("batch"), std::string::npos);
  EXPECT_EQ(refused_line("3").code, ErrorCode::invalid_request);
  EXPECT_EQ(refused_line("nonsense").code, ErrorCode::parse_error);
}

TEST(DecodeRequest, NamesTheFieldOfABadFrame) {
  EXPECT_EQ(refused_line(R"({"id":1,"method":"ping","params":{}})").field, "/jsonrpc");
  EXPECT_EQ(refused_line(R"({"jsonrpc":2.0,"id":1,"method":"ping"})").field, "/jsonrpc");
  EXPECT_EQ(refused_line(R"({"jsonrpc":"2.0","id":1})").field, "/method");
  EXPECT_EQ(refused_line(R"({"jsonrpc":"2.0","id":1,"method":5})").field, "/method");
  EXPECT_EQ(refused_line(R"({"jsonrpc":"2.0","id":[1],"method":"ping"})").field, "/id");
  EXPECT_EQ(refused_line(R"({"jsonrpc":"2.0","id":1,"method":"ack"})").field, "/params");
  EXPECT_EQ(refused("ack", "[1]").field, "/params");
}

TEST(DecodeRequest, SaysThatAMethodIsUnknownUnderTheRequestsId) {
  const auto bad =
      decode_request(R"({"jsonrpc":"2.0","id":"q","method":"fly","params":{}})", default_limits);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().id.json, "\"q\"");
  EXPECT_EQ(bad.error().error.code, ErrorCode::method_not_found);
  EXPECT_EQ(bad.error().error.field, "/method");
}

TEST(DecodeRequest, IgnoresMembersThatItDoesNotKnow) {
  EXPECT_EQ(decoded<Ack>("ack", R"({"game":4,"mood":"good"})").what, Ended{GameId{4}});
  EXPECT_EQ(decoded<Ack>("ack", R"({"match":4})").what, Ended{MatchId{4}});
  EXPECT_EQ(decoded<Ack>("ack", R"({"tournament":4})").what, Ended{TournamentId{4}});
  EXPECT_EQ(decoded<Ack>("ack", R"({"match":5,"game":4})").what, Ended{GameId{4}});
  EXPECT_EQ(refused("ack", "{}").field, "/params/game");
  EXPECT_TRUE(decode_request(R"({"jsonrpc":"2.0","id":1,"method":"tournament.list","extra":[]})",
                             default_limits));
}

TEST(DecodeRequest, AsksForNoParamsWhereNoneAreNeeded) {
  EXPECT_TRUE(decode_request(R"({"jsonrpc":"2.0","id":1,"method":"ping"})", default_limits));
  EXPECT_TRUE(
      decode_request(R"({"jsonrpc":"2.0","id":1,"method":"tournament.list"})", default_limits));
  EXPECT_EQ(refused("ping", "3").field, "/params");
  EXPECT_EQ(refused("tournament.list", "3").field, "/params");
}

TEST(DecodeRequest, TakesNoNameThatAPageCouldNotHave) {
  EXPECT_EQ(refused("register", R"({"name":"."})").code, ErrorCode::bad_name);
  EXPECT_EQ(refused("register", R"({"name":".."})").code, ErrorCode::bad_name);
  EXPECT_EQ(decoded<Register>("register", R"({"name":"..."})").name, "...");
}

// Where a name or an object is expected a token may come by mistake, and refusals are logged.
TEST(DecodeRequest, TellsNoTokenThatCameInTheWrongPlace) {
  const std::string token(64, 'a');
  const Error error = refused("register", '"' + token + '"');
  EXPECT_EQ(error.reason.find("aaaa"), std::string::npos) << error.reason;
  EXPECT_NE(error.reason.find("64 characters"), std::string::npos) << error.reason;
}

TEST(DecodeRequest, RepeatsNoLongKeyInItsAnswer) {
  const std::string key(30'000, 'k');
  const Error error = refused("ack", "{\"" + key + "\":1,\"" + key + "\":2}");
  EXPECT_EQ(error.field, "/params/" + std::string(64, 'k'));
}

TEST(DecodeRequest, NamesTheGameThatABadRequestIsAbout) {
  EXPECT_EQ(refused("shot", R"({"game":12})").game, GameId{12});
  EXPECT_FALSE(refused("shot", R"({"game":"x"})").game);
}

// ---- Session ----

TEST(DecodeRequest, ReadsHello) {
  const auto hello = decoded<Hello>(
      "hello",
      R"({"protocol":[1,4],"name":"b","client":{"name":"c","version":"2"},"detail":"summary"})");
  EXPECT_EQ(hello.least_protocol, 1);
  EXPECT_EQ(hello.most_protocol, 4);
  EXPECT_EQ(hello.client->version, "2");
  EXPECT_EQ(hello.detail, EventDetail::summary);
  EXPECT_EQ(decoded<Hello>("hello", R"({"protocol":[1,1],"name":"b"})").detail, EventDetail::full);
}

TEST(DecodeRequest, NamesTheFieldOfABadHello) {
  EXPECT_EQ(refused("hello", R"({"name":"b"})").field, "/params/protocol");
  EXPECT_EQ(refused("hello", R"({"protocol":[1],"name":"b"})").field, "/params/protocol");
  EXPECT_EQ(refused("hello", R"({"protocol":[1,"2"],"name":"b"})").field, "/params/protocol/1");
  EXPECT_EQ(refused("hello", R"({"protocol":[2,1],"name":"b"})").field, "/params/protocol/1");
  EXPECT_EQ(refused("hello", R"({"protocol":[1,1],"name":"b","detail":"x"})").field,
            "/params/detail");
  const std::string client = R"({"protocol":[1,1],"name":"b","client":{"name":")";
  EXPECT_TRUE(
      decode_request(line("hello", client + std::string(64, 'c') + R"("}})"), default_limits));
  EXPECT_EQ(refused("hello", client + std::string(65, 'c') + R"("}})").field,
            "/params/client/name");
}

TEST(DecodeRequest, TakesNamesOfOneTo32CharactersOnly) {
  const auto named = [](const std::string& name) {
    return decode_request(line("register", R"({"name":")" + name + R"("})"), default_limits);
  };
  EXPECT_TRUE(named("a"));
  EXPECT_TRUE(named(std::string(32, 'Z')));
  for (const std::string& name :
       {std::string(), std::string(33, 'Z'), std::string("a b"), std::string("é"),
        std::string("a\\u0000"), std::string("a/b"), std::string("house:x")}) {
    const auto bad = named(name);
    ASSERT_FALSE(bad) << name;
    EXPECT_EQ(bad.error().error.code, ErrorCode::bad_name);
    EXPECT_EQ(bad.error().error.field, "/params/name");
  }
}

TEST(DecodeRequest, TakesTokensInEitherCaseAndNeverRepeatsThem) {
  const std::string token = "ABCDEF" + std::string(58, '0');
  EXPECT_EQ(decoded<Login>("login", R"({"token":")" + token + R"("})").token.text,
            "abcdef" + std::string(58, '0'));
  const std::string almost(63, 'a');
  const Error error = refused("login", R"({"token":")" + almost + R"("})");
  EXPECT_EQ(error.field, "/params/token");
  EXPECT_EQ(error.reason.find("aaa"), std::string::npos);
}

// ---- Games ----

TEST(DecodeRequest, ReadsAShotAsItStands) {
  const Shot shot = decoded<Shot>("shot", good_shot);
  EXPECT_EQ(shot.game, GameId{3});
  EXPECT_EQ(shot.turn, 2U);
  EXPECT_EQ(shot.shot_id.json, "\"s\"");
  EXPECT_EQ(shot.params, (ShotParams{1, -2, 5, 90.5, 3}));
  EXPECT_FALSE(shot.cue_ball);
  EXPECT_EQ(shot.call.kind, rules::Call::Kind::none);
}

TEST(DecodeRequest, ReadsEveryKindOfCall) {
  using Kind = rules::Call::Kind;
  EXPECT_EQ(decoded<Shot>("shot", shot_with("call", "\"safety\"")).call.kind, Kind::safety);
  EXPECT_EQ(decoded<Shot>("shot", shot_with("call", "\"push_out\"")).call.kind, Kind::push_out);
  EXPECT_EQ(decoded<Shot>("shot", shot_with("call", "null")).call.kind, Kind::none);
  const auto call =
      decoded<Shot>("shot", shot_with("call", R"({"ball":8,"pocket":"foot_left"})")).call;
  EXPECT_EQ(call, (rules::Call{Kind::pocket, physics::BallId{8}, physics::PocketId::foot_left}));
}

TEST(DecodeRequest, ReadsThePlaceOfTheCueBall) {
  const auto shot = decoded<Shot>("shot", shot_with("cue_ball", R"({"x":0.25,"y":0.5})"));
  EXPECT_EQ(shot.cue_ball, (physics::Vec2<double>{0.25, 0.5}));
}

TEST(DecodeRequest, NamesTheFieldOfABadShotAndWhatCame) {
  const std::string good(good_shot);
  EXPECT_EQ(refused("shot", replaced(good, "\"v\":3", "\"v\":\"fast\"")).field, "/params/params/v");
  EXPECT_NE(refused("shot", replaced(good, "\"v\":3", "\"v\":\"fast\"")).reason.find("fast"),
            std::string::npos);
  EXPECT_EQ(refused("shot", replaced(good, "\"v\":3", "\"w\":3")).field, "/params/params/v");
  EXPECT_EQ(refused("shot", replaced(good, "\"v\":3", "\"v\":null")).field, "/params/params/v");
  EXPECT_EQ(refused("shot", replaced(good, "\"turn\":2", "\"turn\":0")).field, "/params/turn");
  EXPECT_EQ(refused("shot", replaced(good, "\"turn\":2", "\"turn\":1.5")).field, "/params/turn");
  EXPECT_EQ(refused("shot", replaced(good, "\"game\":3", "\"game\":-3")).field, "/params/game");
  EXPECT_EQ(refused("shot", replaced(good, "\"game\":3", "\"game\":9223372036854775808")).field,
            "/params/game");
  EXPECT_EQ(refused("shot", shot_with("call", "\"miss\"")).field, "/params/call");
  EXPECT_EQ(refused("shot", shot_with("call", R"({"ball":16,"pocket":"foot_left"})")).field,
            "/params/call/ball");
  EXPECT_EQ(refused("shot", shot_with("call", R"({"ball":1,"pocket":"left"})")).field,
            "/params/call/pocket");
  EXPECT_EQ(refused("shot", shot_with("cue_ball", R"({"x":1})")).field, "/params/cue_ball/y");
}

TEST(DecodeRequest, TakesShotIdsOfOneTo64CharactersAndIntegers) {
  const std::string good(good_shot);
  const auto with_id = [&](const std::string& id) {
    return decode_request(line("shot", replaced(good, "\"s\"", id)), default_limits);
  };
  EXPECT_TRUE(with_id("-5"));
  std::string accents;
  for (int i = 0; i < 64; ++i) {
    accents += "\xc3\xa9";
  }
  EXPECT_TRUE(with_id('"' + accents + '"'));
  EXPECT_FALSE(with_id('"' + accents + "x\""));
  EXPECT_FALSE(with_id("\"\""));
  EXPECT_FALSE(with_id("1.5"));
  EXPECT_FALSE(with_id("null"));
  EXPECT_FALSE(with_id("{}"));
}

TEST(DecodeRequest, KeepsAShotIdOfANumberApartFromThatOfAString) {
  const std::string good(good_shot);
  EXPECT_NE(decoded<Shot>("shot", replaced(good, "\"s\"", "7")),
            decoded<Shot>("shot", replaced(good, "\"s\"", "\"7\"")));
}

TEST(DecodeRequest, HoldsShotsOfTheSameValuesForEqual) {
  const std::string good(good_shot);
  EXPECT_EQ(
      decoded<Shot>("shot", good),
      decoded<Shot>("shot", replaced(replaced(good, "90.5", "905e-1"), "\"s\"", "\"\\u0073\"")));
}

TEST(DecodeRequest, ReadsAChallenge) {
  const auto challenge = decoded<Challenge>(
      "challenge",
      R"({"opponent":"house:greedy","rules":"9-ball","noise":"high","clock":{"game_ms":5000}})");
  EXPECT_EQ(challenge.rules, rules::RuleSet::nine_ball);
  EXPECT_EQ(challenge.noise, "high");
  EXPECT_EQ(challenge.clock, (ClockSettings{5000, 0, std::nullopt}));
}

TEST(DecodeRequest, NamesTheFieldOfABadChallenge) {
  EXPECT_EQ(refused("challenge", R"({})").field, "/params/opponent");
  EXPECT_EQ(refused("challenge", R"({"opponent":"house:"})").field, "/params/opponent");
  EXPECT_EQ(refused("challenge", R"({"opponent":"a","rules":"snooker"})").field, "/params/rules");
  EXPECT_EQ(refused("challenge", R"({"opponent":"a","noise":"loud"})").field, "/params/noise");
  EXPECT_EQ(refused("challenge", R"({"opponent":"a","clock":{"game_ms":0}})").field,
            "/params/clock/game_ms");
}

TEST(DecodeRequest, ReadsDecisions) {
  const auto decide = decoded<Decide>("decide", R"({"game":1,"turn":2,"choice":"spot_eight"})");
  EXPECT_EQ(decide.choice, rules::Decision::spot_eight);
  EXPECT_EQ(refused("decide", R"({"game":1,"turn":2,"choice":"win"})").field, "/params/choice");
}

TEST(DecodeRequest, GivesPingsTimeBackAsItIs) {
  EXPECT_EQ(decoded<Ping>("ping", R"({"t":1.25})").t.text, "1.25");
  EXPECT_EQ(decoded<Ping>("ping", R"({"t":"x"})").t.text, "\"x\"");
  EXPECT_EQ(decoded<Ping>("ping", "{}").t.text, "null");
  EXPECT_EQ(refused("ping", R"({"t":[1]})").field, "/params/t");
}

}  // namespace
}  // namespace poolhall::protocol

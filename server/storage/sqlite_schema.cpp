#include "server/storage/sqlite_schema.hpp"

#include <array>

namespace poolhall::storage {
namespace {

// Small columns stand before big ones, so that counting and looking up reads one page a row.
constexpr std::string_view first = R"sql(
CREATE TABLE agents(
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL COLLATE NOCASE UNIQUE,
  token_hash BLOB NOT NULL UNIQUE,
  house_bot TEXT,
  created INTEGER NOT NULL
) STRICT;

CREATE TABLE tournaments(
  id TEXT NOT NULL PRIMARY KEY,
  wire_id INTEGER NOT NULL UNIQUE,
  title TEXT NOT NULL,
  settings TEXT NOT NULL,
  status TEXT NOT NULL,
  created INTEGER NOT NULL
) STRICT;

CREATE TABLE entries(
  tournament TEXT NOT NULL REFERENCES tournaments,
  agent INTEGER NOT NULL REFERENCES agents,
  place INTEGER NOT NULL,
  withdrawn INTEGER NOT NULL,
  house_bot TEXT,
  command TEXT,
  PRIMARY KEY(tournament, agent),
  UNIQUE(tournament, place)
) STRICT, WITHOUT ROWID;

CREATE TABLE entry_options(
  tournament TEXT NOT NULL,
  agent INTEGER NOT NULL,
  position INTEGER NOT NULL,
  option TEXT NOT NULL,
  PRIMARY KEY(tournament, agent, position),
  FOREIGN KEY(tournament, agent) REFERENCES entries
) STRICT, WITHOUT ROWID;

CREATE TABLE matches(
  id INTEGER PRIMARY KEY,
  tournament TEXT REFERENCES tournaments,
  pairing INTEGER,
  request TEXT UNIQUE,
  first_agent INTEGER NOT NULL REFERENCES agents,
  second_agent INTEGER NOT NULL REFERENCES agents,
  games INTEGER NOT NULL,
  rules TEXT NOT NULL,
  table_name TEXT NOT NULL,
  materials TEXT NOT NULL,
  noise TEXT NOT NULL,
  noise_hidden INTEGER NOT NULL,
  rack_gap REAL NOT NULL,
  rack_jitter REAL NOT NULL,
  clock_us INTEGER NOT NULL,
  increment_us INTEGER NOT NULL,
  shot_cap_us INTEGER,
  max_refusals INTEGER NOT NULL,
  lag_per_turn_us INTEGER NOT NULL,
  lag_per_game_us INTEGER NOT NULL,
  seed INTEGER NOT NULL,
  mirrored INTEGER NOT NULL,
  over INTEGER NOT NULL,
  created INTEGER NOT NULL,
  finished INTEGER,
  UNIQUE(tournament, pairing)
) STRICT;
CREATE INDEX unfinished_matches ON matches(id) WHERE over = 0;

CREATE TABLE games(
  id INTEGER PRIMARY KEY,
  match INTEGER NOT NULL REFERENCES matches,
  number INTEGER NOT NULL,
  attempt INTEGER NOT NULL,
  first_agent INTEGER NOT NULL REFERENCES agents,
  second_agent INTEGER NOT NULL REFERENCES agents,
  rules TEXT NOT NULL,
  table_name TEXT NOT NULL,
  materials TEXT NOT NULL,
  noise TEXT NOT NULL,
  noise_hidden INTEGER NOT NULL,
  rack_gap REAL NOT NULL,
  rack_jitter REAL NOT NULL,
  clock_us INTEGER NOT NULL,
  increment_us INTEGER NOT NULL,
  shot_cap_us INTEGER,
  max_refusals INTEGER NOT NULL,
  lag_per_turn_us INTEGER NOT NULL,
  lag_per_game_us INTEGER NOT NULL,
  breaker INTEGER NOT NULL,
  rack_seed INTEGER NOT NULL,
  noise_key BLOB NOT NULL,
  noise_a REAL NOT NULL,
  noise_b REAL NOT NULL,
  noise_theta REAL NOT NULL,
  noise_phi REAL NOT NULL,
  noise_v REAL NOT NULL,
  commitment BLOB NOT NULL,
  initial_state TEXT NOT NULL,
  physics_version TEXT NOT NULL,
  rules_version TEXT NOT NULL,
  created INTEGER NOT NULL,
  over INTEGER NOT NULL,
  winner INTEGER,
  reason TEXT,
  turns INTEGER NOT NULL,
  head BLOB NOT NULL,
  first_acknowledged INTEGER NOT NULL,
  second_acknowledged INTEGER NOT NULL,
  finished INTEGER,
  seal BLOB NOT NULL,
  UNIQUE(match, number, attempt)
) STRICT;
CREATE INDEX unfinished_games ON games(id) WHERE over = 0;
CREATE INDEX untold_first ON games(first_agent) WHERE over = 1 AND first_acknowledged = 0;
CREATE INDEX untold_second ON games(second_agent) WHERE over = 1 AND second_acknowledged = 0;

CREATE TABLE turns(
  game INTEGER NOT NULL REFERENCES games,
  number INTEGER NOT NULL,
  action TEXT NOT NULL,
  seat INTEGER NOT NULL,
  request TEXT,
  shot_index INTEGER,
  intended_a REAL,
  intended_b REAL,
  intended_theta REAL,
  intended_phi REAL,
  intended_v REAL,
  executed_a REAL,
  executed_b REAL,
  executed_theta REAL,
  executed_phi REAL,
  executed_v REAL,
  moved INTEGER,
  cue_ball_x REAL,
  cue_ball_y REAL,
  call_kind TEXT,
  call_ball INTEGER,
  call_pocket TEXT,
  decision TEXT,
  winner INTEGER,
  reason TEXT,
  refusals INTEGER NOT NULL,
  used_us INTEGER NOT NULL,
  forgiven_us INTEGER NOT NULL,
  first_left_us INTEGER NOT NULL,
  second_left_us INTEGER NOT NULL,
  first_lag_left_us INTEGER NOT NULL,
  second_lag_left_us INTEGER NOT NULL,
  stored INTEGER NOT NULL,
  physics_version TEXT NOT NULL,
  rules_version TEXT NOT NULL,
  checksum BLOB NOT NULL,
  state_before TEXT NOT NULL,
  state_after TEXT NOT NULL,
  ruling TEXT,
  events TEXT,
  PRIMARY KEY(game, number)
) STRICT;
)sql";

// Ends that agents have not acknowledged, and how tournaments ended. What ended before this schema
// counts as told.
constexpr std::string_view second = R"sql(
ALTER TABLE matches ADD COLUMN challenge INTEGER;

CREATE TABLE untold_matches(
  agent INTEGER NOT NULL REFERENCES agents,
  match INTEGER NOT NULL REFERENCES matches,
  PRIMARY KEY(agent, match)
) STRICT, WITHOUT ROWID;

CREATE TABLE untold_tournaments(
  agent INTEGER NOT NULL REFERENCES agents,
  tournament TEXT NOT NULL REFERENCES tournaments,
  PRIMARY KEY(agent, tournament)
) STRICT, WITHOUT ROWID;

CREATE TABLE final_standings(
  tournament TEXT NOT NULL REFERENCES tournaments,
  place INTEGER NOT NULL,
  rank INTEGER NOT NULL,
  agent TEXT NOT NULL,
  points REAL NOT NULL,
  games INTEGER NOT NULL,
  wins INTEGER NOT NULL,
  losses INTEGER NOT NULL,
  draws INTEGER NOT NULL,
  PRIMARY KEY(tournament, place)
) STRICT, WITHOUT ROWID;
)sql";

// The agents' parts in the noise, mirrored noise, and a checksum over a match's row.
constexpr std::string_view fair_noise = R"sql(
ALTER TABLE matches ADD COLUMN seal BLOB;
ALTER TABLE games ADD COLUMN first_commitment BLOB;
ALTER TABLE games ADD COLUMN second_commitment BLOB;
ALTER TABLE games ADD COLUMN shared_from INTEGER REFERENCES games;
ALTER TABLE games ADD COLUMN first_secret BLOB;
ALTER TABLE games ADD COLUMN second_secret BLOB;
ALTER TABLE turns ADD COLUMN shared INTEGER;
)sql";

// The rounds that an entry takes part in.
constexpr std::string_view entry_rounds = R"sql(
ALTER TABLE entries ADD COLUMN from_round INTEGER NOT NULL DEFAULT 0;
ALTER TABLE entries ADD COLUMN until_round INTEGER;
UPDATE entries SET until_round = 0 WHERE withdrawn = 1;
ALTER TABLE entries DROP COLUMN withdrawn;
)sql";

// A turn's long texts in one compressed value (turn_texts.hpp); rows that have them apart stay.
constexpr std::string_view packed_texts = R"sql(
ALTER TABLE turns ADD COLUMN texts BLOB;
)sql";

constexpr std::array<std::string_view, 5> all{first, second, fair_noise, entry_rounds,
                                              packed_texts};

}  // namespace

std::span<const std::string_view> migrations() {
  return all;
}

}  // namespace poolhall::storage

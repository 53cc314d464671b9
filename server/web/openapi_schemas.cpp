#include "server/web/openapi_schemas.hpp"

namespace poolhall::web {

// NOLINTNEXTLINE(readability-function-size): one document, written as it is served
std::string_view openapi_schemas() {
  return R"({
"Refusal": {
  "type": "object",
  "properties": {
    "error": {
      "type": "object",
      "properties": {
        "code": {"type": "string"}, "reason": {"type": "string"},
        "field": {"type": "string", "description": "JSON Pointer into the request"}
      },
      "required": ["code", "reason"]
    }
  },
  "required": ["error"]
},
"Health": {"type": "object", "properties": {"status": {"const": "ok"}}, "required": ["status"]},
"Done": {"type": "object", "description": "server/web/README.md, The host's calls"},
"Rules": {"enum": ["8-ball", "9-ball"]},
"Params": {
  "type": "object",
  "properties": {
    "a": {"type": "number"}, "b": {"type": "number"}, "theta": {"type": "number"},
    "phi": {"type": "number"}, "v": {"type": "number"}
  },
  "required": ["a", "b", "theta", "phi", "v"], "description": "mm, mm, degrees, degrees, m/s"
},
"Winner": {"enum": [0, 1, null], "description": "A seat; null: nobody"},
"Hex": {"type": "string", "pattern": "^[0-9a-f]{64}$"},
"State": {"type": "object", "description": "protocol/README.md, State"},
"Estimate": {
  "anyOf": [
    {
      "type": "object", "properties": {"elo": {"type": "number"}, "margin": {"type": "number"}},
      "required": ["elo", "margin"], "description": "elo +- margin is a 95 % interval"
    },
    {"type": "null"}
  ]
},
"Entry": {
  "type": "object",
  "properties": {"agent": {"type": "string"}, "withdrawn": {"type": "boolean"}},
  "required": ["agent", "withdrawn"]
},
"Live": {
  "type": "object",
  "properties": {
    "games": {
      "type": "array",
      "items": {
        "type": "object",
        "properties": {
          "game": {"type": "integer"},
          "agents": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2},
          "turn": {"type": "integer"}, "to_move": {"enum": [0, 1]}, "kind": {"type": "string"},
          "state": {"$ref": "#/components/schemas/State"}
        },
        "required": ["game", "agents"]
      }
    }
  },
  "required": ["games"]
},
"RatingPoint": {
  "type": "object",
  "properties": {
    "when_ms": {"type": "integer"}, "games": {"type": "integer"}, "rating": {"type": "number"},
    "deviation": {"type": "number"}
  },
  "required": ["when_ms", "games", "rating", "deviation"]
},
"Agents": {
  "type": "object",
  "properties": {
    "agents": {
      "type": "array",
      "items": {
        "type": "object",
        "properties": {
          "agent": {"type": "string"}, "house": {"type": "boolean"},
          "games": {"type": "integer"}, "wins": {"type": "integer"},
          "losses": {"type": "integer"}, "draws": {"type": "integer"},
          "rating": {"type": "number"}, "deviation": {"type": "number"},
          "history": {"type": "array", "items": {"$ref": "#/components/schemas/RatingPoint"}}
        },
        "required": [
          "agent", "house", "games", "wins", "losses", "draws", "rating", "deviation", "history"
        ]
      }
    }
  },
  "required": ["agents"]
},
"AgentPage": {
  "type": "object",
  "properties": {
    "agent": {"type": "string"}, "house": {"type": "boolean"}, "games": {"type": "integer"},
    "wins": {"type": "integer"}, "losses": {"type": "integer"}, "draws": {"type": "integer"},
    "rating": {"type": "number"}, "deviation": {"type": "number"},
    "history": {"type": "array", "items": {"$ref": "#/components/schemas/RatingPoint"}},
    "last_games": {
      "type": "array",
      "items": {
        "type": "object",
        "properties": {
          "game": {"type": "integer"},
          "agents": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2},
          "rules": {"$ref": "#/components/schemas/Rules"},
          "winner": {"$ref": "#/components/schemas/Winner"}, "reason": {"type": "string"},
          "finished_ms": {"type": "integer"}
        },
        "required": ["game", "agents", "rules", "winner", "reason", "finished_ms"]
      }
    }
  },
  "required": [
    "agent", "house", "games", "wins", "losses", "draws", "rating", "deviation", "history",
    "last_games"
  ]
},
"Tournaments": {
  "type": "object",
  "properties": {
    "tournaments": {
      "type": "array",
      "items": {
        "type": "object",
        "properties": {
          "tournament": {"type": "string"}, "wire_id": {"type": "integer"},
          "title": {"type": "string"},
          "status": {"enum": ["open", "running", "paused", "finished", "aborted"]},
          "created_ms": {"type": "integer"}, "format": {"type": "string"},
          "rules": {"$ref": "#/components/schemas/Rules"},
          "games_per_match": {"type": "integer"}, "table": {"type": "string"},
          "physics": {"type": "string"}, "games_over": {"type": "integer"},
          "games_running": {"type": "integer"}, "games_planned": {"type": ["integer", "null"]},
          "entries": {"type": "array", "items": {"$ref": "#/components/schemas/Entry"}}
        },
        "required": [
          "tournament", "wire_id", "title", "status", "created_ms", "games_over",
          "games_running", "games_planned", "entries"
        ]
      }
    }
  },
  "required": ["tournaments"]
},
"Standing": {
  "type": "object",
  "properties": {
    "rank": {"type": "integer"}, "agent": {"type": "string"}, "points": {"type": "number"},
    "games": {"type": "integer"}, "wins": {"type": "integer"}, "losses": {"type": "integer"},
    "draws": {"type": "integer"}, "tie_breaks": {"type": "array", "items": {"type": "number"}},
    "rating": {
      "enum": ["rated", "won_everything", "lost_everything", "unconnected", "no_games"]
    },
    "estimate": {"$ref": "#/components/schemas/Estimate"}, "group": {"type": "integer"},
    "superiority": {
      "type": ["number", "null"], "description": "Likelihood of superiority over the next row"
    }
  },
  "required": [
    "rank", "agent", "points", "games", "wins", "losses", "draws", "tie_breaks", "rating",
    "estimate", "group", "superiority"
  ]
},
"Match": {
  "type": "object",
  "properties": {
    "match": {"type": "integer"}, "over": {"type": "boolean"},
    "round": {"type": ["integer", "null"]},
    "agents": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2},
    "games": {
      "type": "array",
      "items": {
        "type": "object",
        "properties": {
          "game": {"type": "integer"}, "number": {"type": "integer"},
          "agents": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2},
          "over": {"type": "boolean"}, "winner": {"$ref": "#/components/schemas/Winner"},
          "reason": {"type": "string"}, "scored": {"type": "boolean"},
          "turns": {"type": "integer"}
        },
        "required": ["game", "number", "agents", "over"]
      }
    }
  },
  "required": ["match", "over", "round", "agents", "games"]
},
"BracketPlace": {
  "type": "object",
  "properties": {
    "round": {"type": "integer"}, "side": {"enum": ["winners", "losers", "final"]},
    "played": {"type": "boolean", "description": "False: somebody has no opponent here"},
    "agents": {"type": "array", "items": {"type": ["string", "null"]}, "minItems": 2, "maxItems": 2},
    "winner": {"type": ["string", "null"]},
    "matches": {"type": "array", "items": {"type": "integer"}}
  },
  "required": ["round", "side", "played", "agents", "winner", "matches"]
},
"TournamentPage": {
  "type": "object",
  "properties": {
    "tournament": {"type": "string"}, "wire_id": {"type": "integer"},
    "title": {"type": "string"},
    "status": {"enum": ["open", "running", "paused", "finished", "aborted"]},
    "created_ms": {"type": "integer"}, "format": {"type": "string"},
    "rules": {"$ref": "#/components/schemas/Rules"}, "games_per_match": {"type": "integer"},
    "table": {"type": "string"}, "physics": {"type": "string"},
    "games_over": {"type": "integer"}, "games_running": {"type": "integer"},
    "games_planned": {"type": ["integer", "null"]},
    "entries": {"type": "array", "items": {"$ref": "#/components/schemas/Entry"}},
    "tie_breaks": {"type": "array", "items": {"type": "string"}},
    "standings": {"type": "array", "items": {"$ref": "#/components/schemas/Standing"}},
    "break_advantage": {"$ref": "#/components/schemas/Estimate"},
    "endings": {"type": "object", "additionalProperties": {"type": "integer"}},
    "rounds_drawn": {"type": ["integer", "null"]}, "rounds": {"type": ["integer", "null"]},
    "sprt": {
      "type": ["object", "null"],
      "properties": {
        "verdict": {"enum": ["undecided", "h0", "h1"]},
        "log_likelihood_ratio": {"type": "number"}, "lower": {"type": "number"},
        "upper": {"type": "number"}, "pairs": {"type": "integer"}
      },
      "required": ["verdict", "log_likelihood_ratio", "lower", "upper", "pairs"]
    },
    "bracket": {
      "type": "array", "description": "Of eliminations",
      "items": {"$ref": "#/components/schemas/BracketPlace"}
    },
    "remarks": {"type": "array", "items": {"type": "string"}},
    "crosstable": {
      "type": "array",
      "items": {
        "type": "array",
        "items": {
          "anyOf": [
            {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
            {"type": "null"}
          ],
          "description": "Points and games of the row against the column"
        }
      }
    },
    "matches": {"type": "array", "items": {"$ref": "#/components/schemas/Match"}}
  },
  "required": [
    "tournament", "wire_id", "title", "status", "created_ms", "games_over", "games_running",
    "games_planned", "entries", "tie_breaks", "standings", "break_advantage", "endings",
    "rounds_drawn", "rounds", "sprt", "bracket", "remarks", "crosstable", "matches"
  ]
},
"TurnHead": {
  "type": "object",
  "properties": {
    "turn": {"type": "integer"}, "by": {"enum": [0, 1]},
    "action": {
      "enum": ["shot", "decision", "lost_turn", "concession", "timeout", "forfeit", "void_game"]
    },
    "stored_ms": {"type": "integer"}, "used_ms": {"type": "number"},
    "left_ms": {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2},
    "intended": {"$ref": "#/components/schemas/Params"},
    "executed": {"$ref": "#/components/schemas/Params"}, "moved": {"type": "boolean"},
    "call": {"type": ["object", "string", "null"]}, "cue_ball": {"type": ["object", "null"]},
    "choice": {"type": "string"}, "ruling": {"type": ["object", "null"]}
  },
  "required": ["turn", "by", "action", "stored_ms", "used_ms", "left_ms", "ruling"]
},
"Game": {
  "type": "object",
  "properties": {
    "game": {"type": "integer"}, "match": {"type": "integer"}, "number": {"type": "integer"},
    "agents": {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2},
    "rules": {"$ref": "#/components/schemas/Rules"}, "table": {"type": "string"},
    "physics": {"type": "string"}, "clock_ms": {"type": "integer"}, "breaker": {"enum": [0, 1]},
    "board": {
      "type": ["object", "null"], "description": "Table and physics with all their numbers"
    },
    "commitment": {"$ref": "#/components/schemas/Hex"}, "physics_version": {"type": "string"},
    "rules_version": {"type": "string"}, "over": {"type": "boolean"},
    "winner": {"$ref": "#/components/schemas/Winner"}, "reason": {"type": "string"},
    "scored": {"type": "boolean"}, "tournament": {"type": ["string", "null"]},
    "noise": {"anyOf": [{"$ref": "#/components/schemas/Params"}, {"const": "hidden"}]},
    "key": {"$ref": "#/components/schemas/Hex"}, "rack_seed": {"type": "integer"},
    "match_score": {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2},
    "initial_state": {"$ref": "#/components/schemas/State"},
    "turns": {"type": "array", "items": {"$ref": "#/components/schemas/TurnHead"}}
  },
  "required": [
    "game", "match", "number", "agents", "rules", "table", "physics", "clock_ms", "breaker",
    "board", "commitment", "physics_version", "rules_version", "over", "tournament", "noise",
    "match_score", "initial_state", "turns"
  ]
},
"Event": {
  "type": "object",
  "properties": {
    "t": {"type": "number"}, "type": {"type": "string"},
    "balls": {"type": "array", "items": {"type": "integer"}}, "rail": {"type": "string"},
    "pocket": {"type": "string"}, "count": {"type": "integer"}, "until": {"type": "number"},
    "after": {"type": "array", "items": {"type": "object"}}
  },
  "required": ["t", "type", "balls"]
},
"Turn": {
  "type": "object",
  "properties": {
    "game": {"type": "integer"}, "turn": {"type": "integer"}, "by": {"enum": [0, 1]},
    "action": {
      "enum": ["shot", "decision", "lost_turn", "concession", "timeout", "forfeit", "void_game"]
    },
    "stored_ms": {"type": "integer"}, "used_ms": {"type": "number"},
    "left_ms": {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2},
    "intended": {"$ref": "#/components/schemas/Params"},
    "executed": {"$ref": "#/components/schemas/Params"}, "moved": {"type": "boolean"},
    "call": {"type": ["object", "string", "null"]}, "cue_ball": {"type": ["object", "null"]},
    "choice": {"type": "string"}, "ruling": {"type": ["object", "null"]},
    "state_before": {"$ref": "#/components/schemas/State"},
    "events": {"type": "array", "items": {"$ref": "#/components/schemas/Event"}},
    "state_after": {"$ref": "#/components/schemas/State"},
    "checksum": {"$ref": "#/components/schemas/Hex"}
  },
  "required": [
    "game", "turn", "by", "action", "stored_ms", "used_ms", "left_ms", "ruling", "state_before",
    "events", "state_after", "checksum"
  ]
},
"Cloud": {
  "type": "object",
  "properties": {
    "samples": {"type": "integer"}, "moved": {"type": "integer"},
    "unfinished": {"type": "integer"},
    "balls": {
      "type": "array",
      "items": {
        "type": "object",
        "properties": {
          "ball": {"type": "integer"},
          "pocketed": {"type": "object", "additionalProperties": {"type": "integer"}},
          "x": {"type": "array", "items": {"type": "number"}},
          "y": {"type": "array", "items": {"type": "number"}}
        },
        "required": ["ball", "pocketed", "x", "y"]
      }
    }
  },
  "required": ["samples", "moved", "unfinished", "balls"]
}
})";
}

}  // namespace poolhall::web

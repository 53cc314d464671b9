// The word for a RatingStatus in tables and in the API.
#pragma once

#include <string_view>

#include "server/ratings/bradley_terry.hpp"

namespace poolhall::ratings {

[[nodiscard]] constexpr std::string_view word(RatingStatus status) {
  switch (status) {
    case RatingStatus::rated:
      return "rated";
    case RatingStatus::won_everything:
      return "won_everything";
    case RatingStatus::lost_everything:
      return "lost_everything";
    case RatingStatus::unconnected:
      return "unconnected";
    case RatingStatus::no_games:
      break;
  }
  return "no_games";
}

}  // namespace poolhall::ratings

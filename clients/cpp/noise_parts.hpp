// The 32 bytes that an agent adds to the noise of each game, so that not even the host can choose
// it: first their SHA-256 (game.ready), and once game.start shows all commitments, they themselves
// (game.reveal).
//
//   NoiseParts parts;
//   send(GameReady{parts.commit()});
//   if (auto secret = parts.secret_for(commitment)) send(GameReveal{game, *secret});
#pragma once

#include <deque>
#include <optional>

#include "protocol/messages.hpp"

namespace poolhall::client {

class NoiseParts {
 public:
  // Bytes of its own for another game; their commitment.
  [[nodiscard]] protocol::Hex256 commit();
  // The bytes behind a commitment, if it is one of the last that were made here.
  [[nodiscard]] std::optional<protocol::Hex256> secret_for(
      const protocol::Hex256& commitment) const;

 private:
  struct Part {
    protocol::Hex256 commitment;
    protocol::Hex256 secret;
  };
  std::deque<Part> parts_;
};

// SHA-256 of 32 bytes, both as hexadecimal digits.
[[nodiscard]] protocol::Hex256 sha256_of(const protocol::Hex256& bytes);

}  // namespace poolhall::client

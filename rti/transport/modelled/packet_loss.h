// Which packets a link loses: each for itself, or in bursts.
#pragma once

namespace rink::rti {

/// A chain of two states, one step before each packet, and a probability of losing the packet in
/// each (Gilbert 1960, Elliott 1963). All numbers in [0, 1].
struct PacketLoss {
  double to_bad = 0.0, to_good = 1.0;      ///< probabilities of changing state
  double loss_good = 0.0, loss_bad = 1.0;  ///< of losing a packet in it

  /// Bernoulli's: each packet is lost with probability `loss`, independently of the others.
  static PacketLoss independent(double loss) { return {0.0, 1.0, loss, loss}; }
  /// Gilbert's: a fraction `loss` below 1 is lost in runs of `burst` packets in the mean, 1 or
  /// more. No chain does this if loss / (1 - loss) > burst.
  static PacketLoss in_bursts(double loss, double burst) {
    return {loss / (1.0 - loss) / burst, 1.0 / burst, 0.0, 1.0};
  }

  bool is_possible() const;
  bool loses_nothing() const { return loss_good == 0.0 && (loss_bad == 0.0 || to_bad == 0.0); }
  /// Fraction of packets that meet the bad state.
  double bad_fraction() const {
    return to_bad + to_good == 0.0 ? 0.0 : to_bad / (to_bad + to_good);
  }
  /// Fraction of packets lost in the long run.
  double loss() const { return (1.0 - bad_fraction()) * loss_good + bad_fraction() * loss_bad; }
  /// Mean number of packets lost in a row: P(lost) / P(lost, and the one after it not).
  double burst() const;
  friend bool operator==(const PacketLoss&, const PacketLoss&) = default;
};

}  // namespace rink::rti

// Sends updates as residuals to the values before, to federates that hold these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rti/baselines/residual_bits.h"
#include "rti/baselines/residual_model.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/federation_basis.h"

namespace rink::rti {

/// A stream loses nothing and keeps order, so a federate to which every update of an object was
/// sent since its full state holds the values that the RTI's residuals refer to;
/// `FederateInterest::holds_former` says of which objects that is so.
class ResidualWriter {
 public:
  ResidualWriter(const FederationBasis& basis, const ResidualModel& model)
      : basis_(basis), model_(model) {}

  void begin_flush(std::span<const UpdateRun> runs);
  /// Sends run number `index` of the flush, where possible as residuals, together with runs after
  /// it; false if the federate must be sent it whole, and isn't yet.
  bool gather(std::size_t index, FlushContext& context);
  /// Notes that the federate is not sent the values of objects out of scope, or before their full
  /// state: what it holds is outdated. Called before full states are written, which may be newer.
  void passed_by(const UpdateRun& run, FederateInterest& interest) const;
  /// Notes that the federate was sent the run's values in full: by this flush's stream, or in a way
  /// by which it may miss them.
  void sent_whole(const UpdateRun& run, FederateInterest& interest) const;
  void sent_otherwise(const UpdateRun& run, FederateInterest& interest) const;
  /// Notes that the federate was sent `set`, all that it gets of the object now.
  void sent_full_state(ObjectSlot slot, AttributeSet set, FederateInterest& interest) const;

 private:
  /// Where a record stands.
  struct Place {
    std::uint32_t handle = 0, run = 0, record = 0;
  };
  /// Runs in sequence that are equal but for their attributes and have no object in common.
  struct Group {
    std::size_t first = 0, end = 0;  ///< runs
    bool is_all_residual = true;
    std::vector<Place> places;       ///< by handle
    std::vector<std::byte> message;  ///< for who receives all of it; written when it is needed
    std::size_t companions = 0;      ///< in it
  };
  bool joins(const Group& group, const UpdateRun& run) const;
  void add(Group& group, std::size_t index);
  bool is_eligible(const UpdateRun& run, const FederateInterest& interest) const;
  bool is_whole(const Group& group, const FederateInterest& interest) const;
  void choose(const Group& group, const FederateInterest& interest);
  /// Returns how many of them are companions.
  std::size_t write(std::span<const Place> places, std::vector<std::byte>& bytes);
  void find_companions(std::span<const Place> places);
  void write_record(std::span<const Place> places, std::size_t index, ResidualCursor& cursor,
                    BitWriter& bits) const;
  const UpdateRun::Record& record(const Place& place) const {
    return runs_[place.run].records[place.record];
  }
  void write_rest(FlushContext& context);

  FederationBasis basis_;
  const ResidualModel& model_;
  std::span<const UpdateRun> runs_;
  std::vector<Group> groups_;
  std::size_t group_count_ = 0;
  std::vector<std::optional<std::uint32_t>> group_of_;  ///< by run
  std::vector<Place> chosen_, rest_;                    ///< as residuals, and whole
  static constexpr std::uint32_t nobody = 0xffffffffu;
  /// By place: the companion that follows it, and whether it follows another.
  std::vector<std::uint32_t> companion_of_;
  std::vector<bool> is_companion_;
  std::vector<std::byte> bits_;
};

}  // namespace rink::rti

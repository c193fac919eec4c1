// Settings of a federation execution: its name, its filter, and the limits of what it accepts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "im/filter.h"
#include "rti/types.h"
#include "rti/update_rate.h"

namespace rink::rti {

struct FederationSettings {
  std::string federation = "rink";
  std::string filter = "none";  ///< an expression that `im::make_filter` takes
  im::FilterSettings filter_settings;
  im::Worker* match_worker = nullptr;   ///< takes half of a match where that pays; null: nobody. It
                                        ///< must outlive the federation
  std::vector<std::string> members{};   ///< names of the federates that may join; none: anybody
  std::uint32_t federate_max = 16'000;  ///< joined at once; below `object_block_max`
  std::uint32_t object_max = 1u << 20;  ///< registered at once; beyond it, who has more than an
                                        ///< even share of them gets no more
  std::uint32_t objects_per_federate_max = object_block;
  std::size_t name_bytes_per_federate_max = 8u
                                            << 20;  ///< of all the objects that it ever registers
  std::size_t interaction_bytes_per_flush_max =
      512u << 10;  ///< that one federate sends to others between two flushes, 16 for each and its
                   ///< parameters
  std::size_t entry_bytes_per_flush_max =
      512u << 10;  ///< to one federate: of objects that came into scope, and their states; less
                   ///< what it has not taken yet
  std::size_t newcomer_pairs_per_match_max =
      ~std::size_t{0};  ///< pairs of a new subscription and an object that one match looks at;
                        ///< further subscriptions wait for later ones. Not for time-constrained
                        ///< federates, who would miss messages until they are taken in
  std::uint32_t timed_max =
      1u
      << 20;  ///< messages in time-stamp order that wait for somebody, or can still be taken back
  std::size_t timed_bytes_max = 256u << 20;  ///< of what they say
  std::uint32_t timed_per_federate_max = 1u
                                         << 18;  ///< of those that their sender can still take back
  std::size_t timed_bytes_per_federate_max = 64u << 20;  ///< of what those messages say
  double save_s_max = 900.0;  ///< that a save or a restore may take [s]; then it fails
  std::size_t save_bytes_max = std::size_t{1} << 30;  ///< of what all ambassadors know, in one save
  Timeouts timeouts;
  UpdateRate update_rate;  ///< of federates that join; FederationExecution::set_update_rate changes
                           ///< that of one
  std::uint32_t keyframe_period =
      1;  ///< every so-many-th flush with periodic state is a keyframe (docs/wire.md, "Baselines")
};

}  // namespace rink::rti

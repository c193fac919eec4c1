// The closed forms of the chain of losses.
#include "rti/transport/modelled/packet_loss.h"

#include <algorithm>
#include <initializer_list>

namespace rink::rti {

bool PacketLoss::is_possible() const {
  const std::initializer_list<double> all{to_bad, to_good, loss_good, loss_bad};
  return std::all_of(all.begin(), all.end(),
                     [](double probability) { return probability >= 0.0 && probability <= 1.0; });
}

double PacketLoss::burst() const {
  const double bad = bad_fraction(), good = 1.0 - bad;
  const double after_good = (1.0 - to_bad) * loss_good + to_bad * loss_bad,
               after_bad = to_good * loss_good + (1.0 - to_good) * loss_bad;
  const double both = good * loss_good * after_good + bad * loss_bad * after_bad;
  return loss() / (loss() - both);
}

}  // namespace rink::rti

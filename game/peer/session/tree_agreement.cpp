// Collects, checks and passes on.
#include "game/peer/session/tree_agreement.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

namespace rink::peer {

static_assert(VerdictBundle::verdicts_max == members_max);

TreeAgreement::TreeAgreement(const State& now, Peer& peer, Inbox& inbox, Mail& mail)
    : now_(now),
      peer_(peer),
      inbox_(inbox),
      mail_(mail),
      tree_(now.members.size()),
      place_(static_cast<std::size_t>(std::ranges::lower_bound(now.members, peer.number()) -
                                      now.members.begin())),
      all_{.is_decision = true,
           .window = peer.verdicts().own().window,
           .verdicts = std::vector<Verdict>(now.members.size())} {
  assert(now.has(peer.number()));
  all_.verdicts[place_] = peer.verdicts().own();
}

std::vector<std::uint8_t> TreeAgreement::run() {
  const std::vector<std::size_t> children = tree_.children(place_);
  for (const std::size_t child : children) collect(child);
  if (place_ > 0) {
    VerdictBundle branch{.window = all_.window};
    for (const std::size_t place : tree_.branch(place_))
      branch.verdicts.push_back(all_.verdicts[place]);
    const std::size_t parent = tree_.parent(place_);
    mail_.send(now_.members[parent], written(std::move(branch)));
    hear_decision(parent);
  }
  for (std::size_t place = 0; place < all_.verdicts.size(); ++place)
    if (place != place_) peer_.receive(now_.members[place], all_.verdicts[place]);
  // Written anew: what was read might have been longer than it need be.
  std::vector<std::uint8_t> bytes = written(std::move(all_));
  for (const std::size_t child : children) mail_.send(now_.members[child], bytes);
  return bytes;
}

VerdictBundle TreeAgreement::received(std::size_t from, bool is_decision, std::size_t count) {
  const PeerNumber sender = now_.members[from];
  auto bundle = inbox_.received<VerdictBundle>(sender, now_);
  if (bundle.is_decision != is_decision || bundle.verdicts.size() != count)
    inbox_.give_up(sender, "passes on " + std::to_string(bundle.verdicts.size()) +
                               " verdicts instead of " + std::to_string(count));
  for (const Verdict& verdict : bundle.verdicts)
    if (const std::string fault = peer_.fault_of(verdict); !fault.empty())
      inbox_.give_up(sender, fault);
  return bundle;
}

void TreeAgreement::collect(std::size_t child) {
  const std::vector<std::size_t> branch = tree_.branch(child);
  VerdictBundle bundle = received(child, false, branch.size());
  for (std::size_t k = 0; k < branch.size(); ++k)
    all_.verdicts[branch[k]] = std::move(bundle.verdicts[k]);
}

void TreeAgreement::hear_decision(std::size_t parent) {
  VerdictBundle decision = received(parent, true, all_.verdicts.size());
  for (const std::size_t place : tree_.branch(place_))
    if (written(decision.verdicts[place]) != written(all_.verdicts[place]))
      inbox_.give_up(now_.members[parent], "hands down another verdict of peer " +
                                               std::to_string(now_.members[place]) +
                                               " than it was sent");
  all_ = std::move(decision);
}

}  // namespace rink::peer

// The functions that are neither compiled from a text nor written as a C++ predicate.
#include "im/pairs/pair_function.h"

#include <cassert>

namespace rink::im {
namespace {

class PluginFunction final : public PairFunction {
 public:
  explicit PluginFunction(const rink_plugin& plugin) : plugin_(plugin) {
    assert(plugin_.version == RINK_PLUGIN_VERSION && plugin_.evaluate != nullptr);
  }
  PairUses uses() const override {
    return {.roles = (plugin_.uses & RINK_USES_ROLES) != 0,
            .motion = (plugin_.uses & RINK_USES_MOTION) != 0,
            .age = (plugin_.uses & RINK_USES_AGE) != 0};
  }
  void evaluate(const rink_pairs& pairs, double* results, double* slacks) override {
    plugin_.evaluate(&pairs, results, slacks);
  }

 private:
  const rink_plugin& plugin_;
};

}  // namespace

std::unique_ptr<PairFunction> make_plugin_function(const rink_plugin& plugin) {
  return std::make_unique<PluginFunction>(plugin);
}

std::unique_ptr<PairFunction> make_nearness() {
  return make_pair_function([](const rink_party& me, const rink_party& its) {
    const double across = its.x - me.x, up = its.y - me.y;
    return -(across * across + up * up);
  });
}

}  // namespace rink::im

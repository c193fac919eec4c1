// Handles interactions for the RTI, and sends the reports that answer them.
#include "rti/federation/management/management_interactions.h"

#include "rti/management/management_values.h"

namespace rink::rti {

namespace {
/// A list of labels is cut before it exceeds an interaction.
constexpr std::size_t label_bytes_max = 30'000;
}  // namespace

/// Handles an interaction whose receiver is the RTI; others may subscribe to it too.
Status ManagementInteractions::take(std::uint32_t slot, const InteractionMessage& message) {
  const InteractionClassHandle asked{message.interaction_class};
  ManagementReader reader(message.parameters);
  if (asked == handles_.set_switches) {
    const std::int32_t value = reader.count();
    if (!reader.is_whole() || !reader.is_at_end() || value < 0 || value > 1)
      return Violation::malformed;
    uses_.requests.provide_automatically(value != 0);
    uses_.objects.switched();
    return std::nullopt;
  }
  if (asked == handles_.request_points) return report_points(slot), std::nullopt;
  const FederateHandle federate{reader.handle()};
  const std::int32_t period = asked == handles_.set_timing ? reader.count() : 0;
  if (!reader.is_whole() || !reader.is_at_end() || period < 0 ||
      !basis_.federates.was_given(federate))
    return Violation::malformed;
  const std::optional<std::uint32_t> found = basis_.federates.joined(federate);
  if (!found) return ++basis_.counters.late_requests, std::nullopt;  // it has left
  const std::uint32_t about = *found;
  if (asked == handles_.set_timing) uses_.objects.timed(about, period);
  if (asked == handles_.request_publications) report_publications(slot, about);
  if (asked == handles_.request_subscriptions) report_subscriptions(slot, about);
  return std::nullopt;
}

/// Sends one report for each class of which `set_of(class)` names attributes, or one without a
/// class if there is none.
template <class SetOf, class Write>
void ManagementInteractions::report_classes(std::uint32_t asking, std::uint32_t about,
                                            InteractionClassHandle report, SetOf set_of,
                                            Write write) {
  std::vector<std::uint32_t> classes;
  for (std::uint32_t i = 0; i < basis_.fom.object_classes().size(); ++i)
    if (!set_of(i).is_empty()) classes.push_back(i);
  const auto notify = [&](std::uint32_t object_class, AttributeSet set) {
    std::vector<std::uint32_t> attributes;
    set.for_each([&](AttributeHandle each) { attributes.push_back(each.value); });
    std::vector<std::byte> parameters;
    ManagementWriter writer(parameters);
    writer.handle(basis_.federates[about].handle.value);
    writer.count(classes.size());
    writer.handle(object_class);
    write(writer, object_class);
    writer.handles(attributes);
    uses_.interactions.report(asking, report, parameters);
  };
  for (const std::uint32_t each : classes) notify(each, set_of(each));
  if (classes.empty()) notify(ObjectClassHandle::none, {});
}

template <class IsNamed>
void ManagementInteractions::report_interactions(std::uint32_t asking, std::uint32_t about,
                                                 InteractionClassHandle report, IsNamed is_named) {
  std::vector<std::uint32_t> classes;
  for (std::uint32_t i = 0; i < basis_.fom.interaction_classes().size(); ++i)
    if (is_named(i)) classes.push_back(i);
  std::vector<std::byte> parameters;
  ManagementWriter writer(parameters);
  writer.handle(basis_.federates[about].handle.value);
  writer.handles(classes);
  uses_.interactions.report(asking, report, parameters);
}

void ManagementInteractions::report_publications(std::uint32_t asking, std::uint32_t about) {
  report_classes(
      asking, about, handles_.report_object_publication,
      [&](std::uint32_t i) { return uses_.publications.of_class(about, i); },
      [](ManagementWriter&, std::uint32_t) {});
  report_interactions(asking, about, handles_.report_interaction_publication, [&](std::uint32_t i) {
    return uses_.publications.has_interaction(about, i);
  });
}

/// Reports the attributes of each class to which the federate subscribes, by that class or a
/// superclass, in any region.
void ManagementInteractions::report_subscriptions(std::uint32_t asking, std::uint32_t about) {
  const auto subscribed = [&](std::uint32_t i) {
    return i < basis_.fom.object_classes().size()
               ? uses_.distribution.subscribed_anywhere(about, static_cast<std::uint16_t>(i))
               : Subscription();
  };
  report_classes(
      asking, about, handles_.report_object_subscription,
      [&](std::uint32_t i) { return subscribed(i).subscribed; },
      [&](ManagementWriter& writer, std::uint32_t i) {
        writer.count(subscribed(i).active.is_empty() ? 0 : 1);
      });
  report_interactions(asking, about, handles_.report_interaction_subscription,
                      [&](std::uint32_t i) {
                        return uses_.interactions.listening(about, static_cast<std::uint16_t>(i)) !=
                               Listening::none;
                      });
}

void ManagementInteractions::report_points(std::uint32_t asking) {
  std::vector<std::byte> labels, parameters;
  for (const SynchronizationPoint& each : uses_.synchronization.points())
    if (labels.size() + each.label.size() <= label_bytes_max)
      ManagementWriter(labels).text(each.label);
  ManagementWriter(parameters).text({reinterpret_cast<const char*>(labels.data()), labels.size()});
  uses_.interactions.report(asking, handles_.report_points, parameters);
}

}  // namespace rink::rti

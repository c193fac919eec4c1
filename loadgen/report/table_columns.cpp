// The definitions, table by table.
#include "loadgen/report/table_columns.h"

#include <array>

namespace rink::loadgen {
namespace {

constexpr std::array of_tidy{
    Definition{"figure", "", "", "name of the figure that the line has"},
    Definition{"unit", "", "", "unit of the value, 1 of counts and fractions"},
    Definition{"value", "", "", "value of the figure in that run"},
};

constexpr std::array of_summaries{
    Definition{"valid_runs", "1", "sample size, replications", "runs of the cell that count"},
    Definition{"invalid_runs", "1", "",
               "runs of the cell that do not count and are in no statistic"},
    Definition{"relevance", "", "", "what truth called relevant to a player, in words"},
    Definition{"FIGURE_mean", "", "", "mean of the figure over the runs that count"},
    Definition{"FIGURE_sd", "", "", "sample standard deviation of the figure over those runs"},
    Definition{"FIGURE_low", "", "", "lower end of the 95 % interval of the mean"},
    Definition{"FIGURE_high", "", "", "upper end of the 95 % interval of the mean"},
    Definition{"FIGURE_min", "", "", "least value of the figure among those runs"},
    Definition{"FIGURE_max", "", "", "largest value of the figure among those runs"},
};

constexpr std::array of_comparisons{
    Definition{"baseline_scheme", "", "",
               "filter of the baseline, empty where it is the row's own"},
    Definition{"baseline_policy", "", "",
               "policy of the baseline, empty where it is the row's own"},
    Definition{"figure", "", "", "name of the figure that is compared"},
    Definition{
        "ratio", "1", "reciprocal of the reduction factor",
        "the cell's value divided by the baseline's, geometric mean over seeds that both ran"},
    Definition{"ratio_low", "1", "", "lower end of the 95 % interval of the ratio"},
    Definition{"ratio_high", "1", "", "upper end of the 95 % interval of the ratio"},
    Definition{"pairs", "1", "sample size",
               "seeds of which cell and baseline both have the figure"},
    Definition{"difference", "", "significance",
               "significance of the difference by its interval, in words"},
    Definition{"baseline", "", "", "all that the baseline is, in words"},
};

constexpr std::array of_equal_errors{
    Definition{"delay_ms", "ms", "one-way delay", "what a packet takes one way in virtual time"},
    Definition{"recall_is", "", "",
               "own: recall of the policy without a margin; asked_for: one that margins reach"},
    Definition{"recall", "1", "", "delivered recall at which both policies are compared"},
    Definition{"rival", "", "", "policy that is compared with the one in the column policy"},
    Definition{"settings", "1", "", "settings of the rival's rate or threshold that were run"},
    Definition{
        "end", "", "",
        "of payload. bracketed: the rival has settings on both sides of the error; not_reached: "
        "for some seed it has none with so small an error; not_left: for some seed none that "
        "errs more sends less, and the ratio is an upper bound"},
    Definition{"payload_ratio", "1", "reduction factor",
               "payload of the rival divided by that of the policy at equal displayed error and "
               "recall, geometric mean over seeds"},
    Definition{"payload_ratio_low", "1", "", "lower end of the 95 % interval of payload_ratio"},
    Definition{"payload_ratio_high", "1", "", "upper end of the 95 % interval of payload_ratio"},
    Definition{
        "wire_ratio", "1", "reduction factor",
        "wire bytes of the rival divided by those of the policy at equal displayed error and "
        "recall, geometric mean over seeds"},
    Definition{"wire_ratio_low", "1", "", "lower end of the 95 % interval of wire_ratio"},
    Definition{"wire_ratio_high", "1", "", "upper end of the 95 % interval of wire_ratio"},
    Definition{"pairs", "1", "sample size", "seeds behind payload_ratio"},
    Definition{"wire_end", "", "", "what end is, of wire bytes"},
    Definition{"points_below", "1", "",
               "settings with that recall and at most that error, for the seed with the fewest"},
    Definition{"points_above", "1", "", "those with a larger error"},
    Definition{"payload_difference", "", "significance",
               "significance by the interval of payload_ratio"},
    Definition{"wire_difference", "", "significance", "significance by the interval of wire_ratio"},
};

constexpr std::array of_growths{
    Definition{"factor", "", "", "what grows: clients, pucks or bats"},
    Definition{"held", "", "", "what stays the same, in words"},
    Definition{"figure", "", "",
               "name of the figure y that grows; total_us_per_tick is physics, filter and sending"},
    Definition{"exponent", "1", "scaling exponent", "k of the power law y = a x^k that fits best"},
    Definition{"exponent_low", "1", "", "lower end of the 95 % interval of the exponent"},
    Definition{"exponent_high", "1", "", "upper end of the 95 % interval of the exponent"},
    Definition{"at_one", "", "", "a of the power law, in the unit of the figure"},
    Definition{"r_squared", "1", "coefficient of determination",
               "part of the variance of the logarithms that the power law explains"},
    Definition{"points", "1", "sample size", "runs behind the fit"},
    Definition{"places", "1", "", "different numbers of what grows"},
    Definition{"bend", "1", "", "largest distance of a mean from the power law, as a fraction"},
    Definition{"misfit_p", "1", "p-value, lack of fit",
               "chance that replications alone make the means bend so much"},
    Definition{
        "is_power_law", "", "",
        "no where the means bend by more than 10 % and would hardly do so by chance; else yes"},
    Definition{"local_exponents", "", "", "exponents between neighbouring numbers, in their order"},
    Definition{"constant", "", "", "c of the line y = c + d x, in the unit of the figure"},
    Definition{"per_one", "", "", "d of that line, in the unit of the figure for each one more"},
    Definition{"better", "", "", "which of power_law and constant_and_proportional fits better"},
};

constexpr std::array of_saturations{
    Definition{"end", "", "", "how the search ended"},
    Definition{"held_clients", "1", "capacity", "most clients with which the server was on time"},
    Definition{"failed_clients", "1", "", "fewest clients with which it was not"},
    Definition{"foretold_clients", "1", "predicted capacity",
               "clients that it holds by the cost of probes of fewer"},
    Definition{"foretold_from_clients", "1", "", "clients of the largest of those probes"},
    Definition{"why", "", "", "why the run with failed_clients failed"},
    Definition{"probes", "1", "", "runs of the search"},
};

constexpr std::array of_server_cores{
    Definition{"figure", "", "", "name of the figure that is compared"},
    Definition{"pairs", "1", "sample size", "seeds that ran with server_cores 1 and 2"},
    Definition{"ratio", "1", "",
               "value with server_cores 2 divided by that with 1, geometric mean over seeds"},
    Definition{"ratio_low", "1", "", "lower end of the 95 % interval of the ratio"},
    Definition{"ratio_high", "1", "", "upper end of the 95 % interval of the ratio"},
};

constexpr std::array of_discoveries{
    Definition{
        "kind", "", "",
        "late_discovery, from becoming relevant to the first delivered state, or missed_contact, "
        "from a contact with a body that the player did not know of to its discovery"},
    Definition{"delay_ms", "ms", "discovery latency", "a delay of that kind"},
    Definition{"fraction", "1", "empirical distribution function",
               "part of the sample that was discovered within the delay"},
    Definition{"samples", "1", "sample size",
               "size of the sample, all valid replications of the cell together"},
    Definition{"never", "1", "censored", "how many of the sample were never discovered"},
};

constexpr std::array of_tables{
    TableColumns{"tidy", of_tidy},
    TableColumns{"summary", of_summaries},
    TableColumns{"comparisons", of_comparisons},
    TableColumns{"equal_error", of_equal_errors},
    TableColumns{"growth", of_growths},
    TableColumns{"saturation", of_saturations},
    TableColumns{"server_cores", of_server_cores},
    TableColumns{"discovery", of_discoveries},
};

}  // namespace

std::span<const TableColumns> table_columns() { return of_tables; }

}  // namespace rink::loadgen

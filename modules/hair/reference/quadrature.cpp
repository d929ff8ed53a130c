#include "modules/hair/reference/quadrature.h"

#include <map>
#include <mutex>

namespace vellus::hair::reference {

namespace {

/// Newton's method on P_n from Chebyshev's approximation of its roots.
GaussRule make_rule(int count) {
    GaussRule rule{std::vector<double>(count), std::vector<double>(count)};
    for (int i = 0; i < count; ++i) {
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
        double slope = 1.0;
        for (int step = 0; step < 8; ++step) {
            double before = 1.0;
            double value = x;
            for (int k = 2; k <= count; ++k) {
                const double next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k;
                before = value;
                value = next;
            }
            slope = count * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        rule.node[i] = x;
        rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

}  // namespace

const GaussRule& gauss_rule(int count) {
    static std::mutex mutex;
    static std::map<int, GaussRule> rules;
    const std::scoped_lock lock(mutex);
    const auto found = rules.find(count);
    if (found != rules.end()) return found->second;
    return rules.emplace(count, make_rule(count)).first->second;
}

}  // namespace vellus::hair::reference

// SPDX-License-Identifier: Apache-2.0
#include "eval/comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "base/error.h"
#include "base/random.h"

namespace ridgeline {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kDraws = 10000;
constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kStage = 601;
constexpr double kRightM = 2.0;
constexpr double kRightDeg = 2.0;

bool IsWithin(const RunRecord& run, double metres, double degrees) {
  return run.error && run.error->translation_m <= metres && run.error->rotation_deg <= degrees;
}

using Key = std::pair<std::string, int>;

std::map<Key, const RunRecord*> ByKey(const System& system) {
  std::map<Key, const RunRecord*> runs;
  for (const RunRecord& record : system.records) {
    const Key key{record.query, system.has_seeds ? record.seed : 0};
    if (runs.emplace(key, &record).second) continue;
    throw InputError(system.name,
                     record.query,
                     "two runs of seed " + std::to_string(record.seed),
                     "one of each query and seed");
  }
  return runs;
}

void AddUnpaired(const Key& key, const std::string& system, std::vector<std::string>& unpaired) {
  unpaired.push_back(key.first +
                     (key.second == 0 ? "" : ", seed " + std::to_string(key.second)) +
                     ": only of " + system);
}

void Join(const System& a, const System& b, Comparison& comparison) {
  const auto runs_a = ByKey(a);
  const auto runs_b = ByKey(b);
  // Of the one with fewer seeds the poses stand beside every seed of the other.
  const auto partner = [](const auto& runs, const System& system, const Key& key) {
    const auto it = runs.find(system.has_seeds ? key : Key{key.first, 0});
    return it == runs.end() ? nullptr : it->second;
  };
  const bool lead_a = a.has_seeds || !b.has_seeds;
  std::set<std::string> joined;
  for (const auto& [key, run] : lead_a ? runs_a : runs_b) {
    const RunRecord* other = lead_a ? partner(runs_b, b, key) : partner(runs_a, a, key);
    if (other == nullptr) {
      AddUnpaired(key, lead_a ? a.name : b.name, comparison.unpaired);
      continue;
    }
    joined.insert(key.first);
    comparison.pairs.push_back(
        {key.first, key.second, lead_a ? run : other, lead_a ? other : run});
  }
  const System& follower = lead_a ? b : a;
  for (const auto& [key, run] : lead_a ? runs_b : runs_a) {
    const bool is_paired = follower.has_seeds ? (lead_a ? runs_a : runs_b).contains(key)
                                              : joined.contains(key.first);
    if (!is_paired) AddUnpaired(key, follower.name, comparison.unpaired);
  }
}

// What is compared: values of both, by query, for the pairs that have them.
struct PairedValues {
  std::vector<std::vector<std::pair<double, double>>> by_query;
  bool is_median = false;  // else a mean
};

using ValuesOf = std::function<std::optional<std::pair<double, double>>(const RunPair&)>;

PairedValues Collect(std::span<const RunPair> pairs, bool is_median, const ValuesOf& of) {
  PairedValues values;
  values.is_median = is_median;
  const std::string* query = nullptr;
  for (const RunPair& pair : pairs) {  // those of one query stand together
    const auto both = of(pair);
    if (!both || !std::isfinite(both->first) || !std::isfinite(both->second)) continue;
    if (query == nullptr || *query != pair.query) values.by_query.emplace_back();
    query = &pair.query;
    values.by_query.back().push_back(*both);
  }
  return values;
}

double MiddleOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

// Both systems' mean or median over some queries, which may repeat.
std::pair<double, double> StatisticOf(const PairedValues& values,
                                      std::span<const std::size_t> queries) {
  std::vector<double> a;
  std::vector<double> b;
  for (const std::size_t q : queries) {
    for (const auto& [of_a, of_b] : values.by_query[q]) {
      a.push_back(of_a);
      b.push_back(of_b);
    }
  }
  if (values.is_median) return {MiddleOf(a), MiddleOf(b)};
  double sum_a = 0.0;
  double sum_b = 0.0;
  for (const double value : a) sum_a += value;
  for (const double value : b) sum_b += value;
  const auto count = static_cast<double>(a.size());
  return {sum_a / count, sum_b / count};
}

Interval95 BootstrapInterval(const PairedValues& values) {
  const std::size_t count = values.by_query.size();
  std::vector<double> differences;
  std::vector<std::size_t> drawn(count);
  for (int draw = 0; draw < kDraws; ++draw) {
    Random random(kSeed, kStage, static_cast<std::uint64_t>(draw));
    for (std::size_t& q : drawn) q = random.Below(count);
    const auto [a, b] = StatisticOf(values, drawn);
    differences.push_back(b - a);
  }
  std::sort(differences.begin(), differences.end());
  const auto at = [&](double share) {
    return differences[static_cast<std::size_t>(share * (kDraws - 1) + 0.5)];
  };
  return {at(0.025), at(0.975)};
}

// Queries on which b has more than a, and less.
std::pair<int, int> Discordant(const PairedValues& values) {
  int more = 0;
  int less = 0;
  for (const auto& query : values.by_query) {
    double sum = 0.0;
    for (const auto& [a, b] : query) sum += b - a;
    more += sum > 0.0 ? 1 : 0;
    less += sum < 0.0 ? 1 : 0;
  }
  return {more, less};
}

ComparedFigure FigureOf(const std::string& name,
                        const std::string& unit,
                        const PairedValues& values) {
  ComparedFigure figure;
  figure.name = name;
  figure.unit = unit;
  figure.mcnemar_p = kNone;
  figure.queries = static_cast<int>(values.by_query.size());
  for (const auto& query : values.by_query) figure.pairs += static_cast<int>(query.size());
  if (figure.queries == 0) {
    figure.a = figure.b = figure.difference = kNone;
    figure.ci95 = {kNone, kNone};
    return figure;
  }
  std::vector<std::size_t> all(values.by_query.size());
  for (std::size_t q = 0; q < all.size(); ++q) all[q] = q;
  std::tie(figure.a, figure.b) = StatisticOf(values, all);
  figure.difference = figure.b - figure.a;
  figure.ci95 = BootstrapInterval(values);
  if (unit != "share") return figure;
  const auto [more, less] = Discordant(values);
  figure.mcnemar_p = SignTest(std::min(more, less), more + less);
  if (figure.ci95.lower == figure.ci95.upper) {
    const double unseen = WilsonInterval(0.0, figure.queries).upper;
    figure.ci95 = {std::max(-1.0, figure.difference - unseen),
                   std::min(1.0, figure.difference + unseen)};
  }
  return figure;
}

void AddFigures(Comparison& comparison) {
  const auto add = [&](const std::string& name,
                       const std::string& unit,
                       bool is_median,
                       const ValuesOf& of) {
    comparison.figures.push_back(FigureOf(name, unit, Collect(comparison.pairs, is_median, of)));
  };
  using Both = std::optional<std::pair<double, double>>;
  for (const RecallThreshold& t : kRecallThresholds) {
    add(std::string("recall ") + t.name, "share", false, [&t](const RunPair& p) -> Both {
      if (!p.a->has_truth) return std::nullopt;
      return std::pair{IsWithin(*p.a, t.translation_m, t.rotation_deg) ? 1.0 : 0.0,
                       IsWithin(*p.b, t.translation_m, t.rotation_deg) ? 1.0 : 0.0};
    });
  }
  const auto add_error = [&](const char* name, const char* unit, double PoseError::*error) {
    add(name, unit, true, [error](const RunPair& p) -> Both {
      if (!p.a->error || !p.b->error) return std::nullopt;
      return std::pair{(*p.a->error).*error, (*p.b->error).*error};
    });
  };
  add_error("median position error where both answer", "m", &PoseError::translation_m);
  add_error("median rotation error where both answer", "deg", &PoseError::rotation_deg);
  add("without a pose", "share", false, [](const RunPair& p) -> Both {
    return std::pair{p.a->pose ? 0.0 : 1.0, p.b->pose ? 0.0 : 1.0};
  });
  add("confident (>= 0.9) and wrong", "share", false, [](const RunPair& p) -> Both {
    if (!p.a->has_truth || std::isnan(p.a->confidence) || std::isnan(p.b->confidence)) {
      return std::nullopt;
    }
    const auto wrong = [](const RunRecord& run) {
      return run.pose && run.confidence >= 0.9 && !IsWithin(run, kRightM, kRightDeg) ? 1.0 : 0.0;
    };
    return std::pair{wrong(*p.a), wrong(*p.b)};
  });
  add("mean confidence", "", false, [](const RunPair& p) -> Both {
    return std::pair{p.a->confidence, p.b->confidence};
  });
  add("median energy where both answer", "", true, [](const RunPair& p) -> Both {
    if (!p.a->pose || !p.b->pose) return std::nullopt;
    return std::pair{p.a->energy, p.b->energy};
  });
  add("median time", "s", true, [](const RunPair& p) -> Both {
    return std::pair{p.a->seconds, p.b->seconds};
  });
}

}  // namespace

double SignTest(int fewer, int all) {
  if (all == 0) return 1.0;
  double tail = 0.0;
  for (int k = 0; k <= fewer; ++k) {
    tail += std::exp(std::lgamma(all + 1.0) - std::lgamma(k + 1.0) - std::lgamma(all - k + 1.0) -
                     all * std::log(2.0));
  }
  return std::min(1.0, 2.0 * tail);
}

Disagreement DisagreementOf(const RunPair& pair) {
  const RunRecord& a = *pair.a;
  const RunRecord& b = *pair.b;
  if (a.has_truth) {
    const bool right_a = IsWithin(a, kRightM, kRightDeg);
    const bool right_b = IsWithin(b, kRightM, kRightDeg);
    if (right_a != right_b) return right_a ? Disagreement::kOnlyA : Disagreement::kOnlyB;
  }
  if (a.pose.has_value() != b.pose.has_value()) return Disagreement::kOneAnswers;
  if (!a.pose) return Disagreement::kNone;
  const PoseError apart = ErrorOf(*a.pose, *b.pose);
  const bool is_apart = apart.translation_m > kRightM || apart.rotation_deg > kRightDeg;
  return is_apart ? Disagreement::kApart : Disagreement::kNone;
}

const char* WordsOf(Disagreement disagreement) {
  switch (disagreement) {
    case Disagreement::kNone:
      return "agree";
    case Disagreement::kOnlyA:
      return "only the first is right";
    case Disagreement::kOnlyB:
      return "only the second is right";
    case Disagreement::kOneAnswers:
      return "only one has a pose";
    case Disagreement::kApart:
      return "poses more than 2 m or 2 deg apart";
  }
  return "";
}

Comparison Compare(const System& a, const System& b) {
  Comparison comparison;
  comparison.a = a.name;
  comparison.b = b.name;
  Join(a, b, comparison);
  if (comparison.pairs.empty()) {
    throw InputError("compare",
                     "",
                     a.name + " and " + b.name + " without a query and seed in common",
                     "results of the same queries and seeds");
  }
  AddFigures(comparison);
  return comparison;
}

}  // namespace ridgeline

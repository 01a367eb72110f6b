// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "eval/binomial.h"
#include "eval/metrics.h"

namespace ridgeline {

// Results of one system on a dataset.
struct System {
  std::string name;
  std::vector<RunRecord> records;
  bool has_seeds = true;  // false: poses of another system, one per query whatever the seed
};

// Two runs of one query and seed.
struct RunPair {
  std::string query;
  int seed = 0;
  const RunRecord* a = nullptr;
  const RunRecord* b = nullptr;
};

// One figure of both systems over their pairs.
struct ComparedFigure {
  std::string name;  // "recall 2m_2deg", "median position error", ...
  std::string unit;  // "share", "m", "deg", "s" or ""
  double a = 0.0;
  double b = 0.0;
  double difference = 0.0;  // b - a
  // 95 % of the difference: paired bootstrap over the queries (10 000 draws of a fixed seed), since
  // the seeds of one query are not independent. Where no query differs in a share, as far as
  // Wilson's bound lets others differ: it never closes on a point.
  Interval95 ci95;
  // McNemar's exact test: two-sided, of the queries on which one is right more often than the
  // other. NaN: no such test.
  double mcnemar_p = 0.0;
  int queries = 0;
  int pairs = 0;
};

// Why two runs of one query disagree.
enum class Disagreement { kNone, kOnlyA, kOnlyB, kOneAnswers, kApart };

struct Comparison {
  std::string a;
  std::string b;
  std::vector<RunPair> pairs;
  std::vector<std::string> unpaired;  // "street_003, seed 2: only of A"
  std::vector<ComparedFigure> figures;
};

// Joins by query and seed; a system without seeds has its poses beside every seed of the other.
// Throws InputError if the two have no query and seed in common, or one has a pair twice.
Comparison Compare(const System& a, const System& b);

// Right or not within 2 m and 2 degrees where the truth is known; answered or not; poses farther
// than that apart.
Disagreement DisagreementOf(const RunPair& pair);
const char* WordsOf(Disagreement disagreement);

// Two-sided exact test of `fewer` of `all` against one half.
double SignTest(int fewer, int all);

}  // namespace ridgeline

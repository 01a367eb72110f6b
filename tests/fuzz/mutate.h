// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace ridgeline::fuzz {

// A damaged copy of a file: a few changes of the kinds that break readers (bits, numbers, cuts,
// repetitions, words of other files). The same generator, the same copy.
//
// @param other  Another file of the corpus, to take pieces from.
std::vector<std::uint8_t> Mutated(std::span<const std::uint8_t> bytes,
                                  std::span<const std::uint8_t> other,
                                  std::mt19937_64& random);

}  // namespace ridgeline::fuzz

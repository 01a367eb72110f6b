// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/study.h"

namespace ridgeline {

// A finished map with its figures as JSON on one line, to the last bit: what is read back stands
// for it in every table and picture.
std::string StudyText(const ScoreStudy& study);

// Throws InputError, naming `file`, for text that is none. Query, score and set are the caller's.
ScoreStudy ReadStudy(const std::string& text, const std::string& file);

}  // namespace ridgeline

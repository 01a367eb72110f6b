// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace ridgeline {

// A planned building to be drawn into the town's pictures: tower.obj, tower.mtl and tower.png, 12 x 12 x
// 29 m around its own origin.
void WriteDemoTower(const std::filesystem::path& folder);

}  // namespace ridgeline

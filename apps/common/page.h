// One HTML page of a study: words, tables, plots, and an animation that plays in real time.
//
// The page needs no other files and no network.  Frames are interpolated at the times of the
// screen's own refreshes, so that playback is in real time whatever their rates are.
#pragma once
#include <string>
#include <vector>

#include "animation.h"
#include "plot.h"

namespace study {

struct PageTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

struct Page {
  std::string title;
  std::vector<std::string> paragraphs;  ///< plain text
  std::vector<PageTable> tables;
  std::vector<Plot> plots;               ///< over time: a line follows the animation
  const Animation* animation = nullptr;  ///< none: no player
};

std::string html(const Page& page);

/// The player's script, a function `play(data)`; for tests.
const char* player_script();

}  // namespace study

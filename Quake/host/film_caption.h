// Captions of a film's lanes, in the engine's own letters.
#pragma once

#include <string>
#include <vector>

#include "lab/film/film_frame.h"
#include "ui/atlas.h"

namespace fb::host {

// Draws a DrawList over packed pixels (red in the lowest byte): nearest texels, straight alpha.
void draw_over(lab::FilmFrame& frame, const scene::DrawList& list);

// Lines at the top left of these columns of the frame, on a dark ground; as large as fits, letters that do not fit at
// the smallest size are cut off whole.
void draw_caption(lab::FilmFrame& frame, ui::Atlas& atlas, const lab::LaneColumns& columns,
                  const std::vector<std::string>& lines);

}  // namespace fb::host

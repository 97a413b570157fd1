// How far a long stage is: a bar in the last line of a terminal, which goes when the stage is over.
// Nothing where messages go to a file or a pipe.

#ifndef FLOWGRID_PROGRESS_H
#define FLOWGRID_PROGRESS_H

#include <string>

namespace flowgrid {

void show_progress(const std::string &stage, double share_done);

// The line is empty again; anything may be printed.
void end_progress();

}    // namespace flowgrid

#endif

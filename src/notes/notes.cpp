#include "notes/notes.h"

namespace plumbline::notes {

std::vector<Note> all() { return {gzrender(), games101(), tinyrenderer(), class_notes()}; }

}  // namespace plumbline::notes

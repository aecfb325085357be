// A process that may write in a few places alone.
#pragma once

namespace plumbline {

/// Whether the kernel can refuse writes (Landlock, Linux 5.13).
bool can_confine();

/// From here on this process and all that it starts can write files in the folders alone that these paths name, a list
/// that ends with null, and in the devices /dev/null, /dev/zero, /dev/tty and /dev/dri; and no file beyond
/// `most_bytes`. Without Landlock, only the size limit holds. Safe between fork() and exec().
void confine(const char* const* folders, unsigned long most_bytes);

}  // namespace plumbline

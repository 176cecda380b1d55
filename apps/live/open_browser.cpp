#include "apps/live/open_browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>

namespace neumann {

bool open_browser(const std::string& address) {
    const auto is_set = [](const char* name) {
        const char* const value = std::getenv(name);
        return value && *value;
    };
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return false;
    posix_spawn_file_actions_t quietly;
    posix_spawn_file_actions_init(&quietly);
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&quietly, file, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t apart;  // the browser outlives a Ctrl-C
    posix_spawnattr_init(&apart);
    posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETSID);
    std::string program = "xdg-open", what = address;
    char* const arguments[] = {program.data(), what.data(), nullptr};
    pid_t process = 0;
    const bool begun = posix_spawnp(&process, program.c_str(), &quietly, &apart, arguments, environ) == 0;
    posix_spawnattr_destroy(&apart);
    posix_spawn_file_actions_destroy(&quietly);
    return begun;
}

}  // namespace neumann

// The system's sockets under names that all systems share. Only address.cpp and system_network.cpp include it.
#pragma once

#if defined(_WIN32)
#include "net/sockets_windows.h"
#else
#include "net/sockets_posix.h"
#endif

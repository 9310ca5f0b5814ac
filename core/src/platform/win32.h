/* What the library calls of Windows. <windows.h> is not included: it defines macros such as near,
 * far, TEXT and DOUBLE, which would affect every later source in the build of one file. */
#ifndef CAROM_SRC_PLATFORM_WIN32_H
#define CAROM_SRC_PLATFORM_WIN32_H
#ifdef _WIN32

#include <stdint.h>

#define KERNEL32(type) __declspec(dllimport) type __stdcall
KERNEL32(int) CloseHandle(void *handle);
KERNEL32(unsigned long) GetActiveProcessorCount(unsigned short group);
KERNEL32(int) QueryPerformanceCounter(int64_t *count);
KERNEL32(int) QueryPerformanceFrequency(int64_t *each_second);
KERNEL32(void) Sleep(unsigned long milliseconds);
KERNEL32(int) SwitchToThread(void);
KERNEL32(unsigned long) WaitForSingleObject(void *handle, unsigned long milliseconds);
#undef KERNEL32

/* of the C library */
uintptr_t __cdecl _beginthreadex(void *security, unsigned stack, unsigned(__stdcall *start)(void *),
                                 void *argument, unsigned flags, unsigned *id);

#endif
#endif

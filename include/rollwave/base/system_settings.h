#ifndef ROLLWAVE_BASE_SYSTEM_SETTINGS_H
#define ROLLWAVE_BASE_SYSTEM_SETTINGS_H

namespace rollwave {

/**
 * What the program settles with the system before anything else, so that faults end it with a
 * message:
 *
 * - Writing to a full disk or a closed pipe is an error of the stream, not the end of the process:
 *   a run whose screen goes away still writes its files.
 * - Standard streams that are closed are opened on nothing, lest a result file takes their place.
 * - Interrupts are heeded, see heed_interrupts().
 */
void settle_process();

} // namespace rollwave

#endif

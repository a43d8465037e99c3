"""Signals as a login shell leaves them, for the programs that a test starts, whatever has started the test: import this.
A program inherits what its parent ignores: nohup SIGHUP, a shell's background job SIGINT, Python itself SIGPIPE and
SIGXFSZ (which subprocess undoes, unless it is told not to: restore_signals stays True)."""
import signal

for number in signal.valid_signals() - {signal.SIGPIPE, signal.SIGXFSZ}:
    if signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, lambda *_: None)  # ignored here still; what is started has the default

% Files of Octave: the numbers are those of corpus.py.
folder = argv(){end};
i = (0:39)';
t = i / 100;
theta_m = round(400e3 * sin(0.3 * i)) / 1e3;
tau = round(25.5e4 * sin(0.3 * i + 0.2)) / 1e4;
save("-v6", fullfile(folder, "octave6.mat"), "t", "tau");
save("-v7", fullfile(folder, "octave7.mat"), "t", "tau");
run = struct("t", t, "theta_m", theta_m, "tau", tau);
save("-v7", fullfile(folder, "octave_struct.mat"), "run");
save("-hdf5", fullfile(folder, "octave.h5"), "t", "tau");
dlmwrite(fullfile(folder, "octave.csv"), [t tau], "precision", "%.16g");

# Files of R: the numbers are those of corpus.py.
folder <- commandArgs(trailingOnly = TRUE)[1]
i <- 0:39
data <- data.frame(t = i / 100, tau = round(25.5 * sin(0.3 * i + 0.2), 4))
write.csv(data, file.path(folder, "r.csv"), row.names = FALSE)
write.csv2(data, file.path(folder, "r_csv2.csv"))
write.table(data, file.path(folder, "r_table.txt"))

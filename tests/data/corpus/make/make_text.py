"""Text tables as benches, loggers and spreadsheets write them."""
import datetime
import io
import zipfile

from corpus import BIG, COUNTS, ROWS, T, T_MS, TAU, THETA, column, expect, refuse, write

NAMES = ["t", "theta_m", "tau"]
SERIES = [T, THETA, TAU]
PLAIN = [column(n, s) for n, s in zip(NAMES, SERIES)]


def comma(value):
    return repr(value).replace(".", ",")


def rows(series, mark, to_text=repr):
    return [mark.join(to_text(v) for v in row) for row in zip(*series)]


def lines(*parts, end="\n"):
    return end.join([line for part in parts for line in ([part] if isinstance(part, str) else part)]) + end


def delimiters():
    write("comma.csv", lines(",".join(NAMES), rows(SERIES, ",")))
    expect("comma.csv", "csv", ("", PLAIN), notes=["separated by ','", "decimal point", "names on line 1"])
    write("semicolon.csv", lines(";".join(NAMES), rows(SERIES, ";", comma)))
    expect("semicolon.csv", "csv", ("", PLAIN), notes=["separated by ';'", "decimal comma"])
    write("tab.tsv", lines("\t".join(NAMES), rows(SERIES, "\t", comma)))
    expect("tab.tsv", "csv", ("", PLAIN), notes=["separated by tabs", "decimal comma"])
    write("pipe.txt", lines(" | ".join(NAMES), rows(SERIES, " | ")))
    expect("pipe.txt", "csv", ("", PLAIN), notes=["separated by '|'"])
    aligned = [f"{a:10.2f} {b:12.3f}   {c:10.4f}" for a, b, c in zip(*SERIES)]
    write("blanks.txt", lines("   ".join(NAMES), aligned))
    expect("blanks.txt", "csv", ("", PLAIN), notes=["separated by blanks"])
    write("sep_line.csv", lines("sep=;", ";".join(NAMES), rows(SERIES, ";")))
    expect("sep_line.csv", "csv", ("", PLAIN), notes=["separated by ';'", "names on line 2"])
    write("trailing.csv", lines(",".join(NAMES) + ",", [r + "," for r in rows(SERIES, ",")]))
    expect("trailing.csv", "csv", ("", PLAIN + [column("column 4", [None] * ROWS)]))
    write("integers.csv", lines("n,counts", rows([range(ROWS), COUNTS], ",")))
    expect("integers.csv", "csv", ("", [column("n", range(ROWS)), column("counts", COUNTS)]))
    write("one_column.csv", lines("counts", [str(v) for v in COUNTS]))
    expect("one_column.csv", "csv", ("", [column("counts", COUNTS)]))


def encodings():
    german = ["Zeit [s]", "Motorwinkel [°]", "Drehmoment [Nm]"]
    text = lines(";".join(german), rows(SERIES, ";", comma))
    table = ("", [column(n, s) for n, s in zip(german, SERIES)])
    write("utf8.csv", text)
    expect("utf8.csv", "csv", table, notes=["UTF-8,"])
    write("utf8_mark.csv", text, "utf-8-sig")
    expect("utf8_mark.csv", "csv", table, notes=["UTF-8 with a byte-order mark"])
    write("latin1.csv", text, "latin-1")
    expect("latin1.csv", "csv", table, notes=["Latin-1"])
    write("utf16.txt", text.replace(";", "\t"), "utf-16")
    expect("utf16.txt", "csv", table, notes=["UTF-16 with a byte-order mark", "tabs"])
    write("utf16_big.csv", text, "utf-16-be")
    expect("utf16_big.csv", "csv", table, notes=["UTF-16,"])
    write("crlf.csv", text.replace("\n", "\r\n"))
    expect("crlf.csv", "csv", table)
    write("old_mac.csv", text.replace("\n", "\r"))
    expect("old_mac.csv", "csv", table)
    write("no_last_end.csv", text[:-1])
    expect("no_last_end.csv", "csv", table)


def numbers():
    quoted = [",".join('"' + comma(v) + '"' for v in row) for row in zip(*SERIES)]
    write("quoted_commas.csv", lines('"t","theta_m","tau"', quoted))
    expect("quoted_commas.csv", "csv", ("", PLAIN), notes=["decimal comma"])
    grouped = [f"{t:.2f};{b:,.1f}".replace(",", "_").replace(".", ",").replace("_", ".") for t, b in zip(T, BIG)]
    write("thousands_de.csv", lines("t;x", grouped))
    table = ("", [column("t", T), column("x", BIG)])
    expect("thousands_de.csv", "csv", table, notes=["decimal comma, digits in groups of three"])
    write("thousands_en.csv", lines('t,"x"', [f'{t},"{b:,.1f}"' for t, b in zip(T, BIG)]))
    expect("thousands_en.csv", "csv", table, notes=["decimal point, digits in groups of three"])
    write("thousands_ch.csv", lines("t;x", [f"{t:.2f};{b:,.1f}".replace(",", "'") for t, b in zip(T, BIG)]))
    expect("thousands_ch.csv", "csv", table)
    write("exponents.csv", lines("t,tau", [f"{t:.6E},{v:+.10e}" for t, v in zip(T, TAU)]))
    expect("exponents.csv", "csv", ("", [column("t", T), column("tau", TAU)]))
    words = ["NaN", "", "#NV", "n/a", "-", "null", "inf", "1.#QNAN", "-nan(ind)", "#DIV/0!"]
    holes = [None if 5 <= i < 5 + len(words) else v for i, v in enumerate(TAU)]
    cells = [words[i - 5] if v is None else repr(v) for i, v in enumerate(holes)]
    write("nan_words.csv", lines("t,tau", [f"{t},{c}" for t, c in zip(T, cells)]))
    expect("nan_words.csv", "csv", ("", [column("t", T), column("tau", holes)]))
    spoilt = [None if i == 7 else v for i, v in enumerate(TAU)]
    cells = ["overflow" if v is None else repr(v) for v in spoilt]
    write("a_word.csv", lines("t,tau", [f"{t},{c}" for t, c in zip(T, cells)]))
    expect("a_word.csv", "csv", ("", [column("t", T), column("tau", spoilt)]),
           notes=["1 cells are no numbers; the first, 'overflow', on line 9"])
    write("text_column.csv", lines("t,state,tau", [f"{t},run,{v}" for t, v in zip(T, TAU)]))
    expect("text_column.csv", "csv", ("", [column("t", T), column("state", [None] * ROWS), column("tau", TAU)]),
           notes=["column 2 'state' is text"])


def headers():
    preamble = ["Pruefstand 2, Getriebe 4711", "Abtastrate: 100 Hz", "", "Bediener;MM", "Datum;03.05.2024", ""]
    write("preamble.csv", lines(preamble, ";".join(NAMES), "s;deg;Nm", rows(SERIES, ";", comma)))
    units = [column(n, s, u) for n, s, u in zip(NAMES, SERIES, ["s", "deg", "Nm"])]
    expect("preamble.csv", "csv", ("", units), notes=["names on line 7, units on line 8, rows from line 9"])
    write("unit_row.csv", lines(",".join(NAMES), "[s],[deg],[Nm]", rows(SERIES, ",")))
    expect("unit_row.csv", "csv", ("", [column(n, s, f"[{u}]") for n, s, u in zip(NAMES, SERIES, ["s", "deg", "Nm"])]))
    write("comments.csv", lines("# made by a logger", "# 100 Hz", ",".join(NAMES), rows(SERIES, ",")[:20],
                                "# paused", rows(SERIES, ",")[20:]))
    expect("comments.csv", "csv", ("", PLAIN))
    write("percent_header.txt", lines("% t theta_m tau", rows(SERIES, " ")))
    expect("percent_header.txt", "csv", ("", PLAIN))
    write("no_header.csv", lines(rows(SERIES, ",")))
    expect("no_header.csv", "csv", ("", [column(f"column {i + 1}", s) for i, s in enumerate(SERIES)]),
           notes=["no line names the 3 columns"])
    write("footer.csv", lines(",".join(NAMES), rows(SERIES, ","), "", "End of measurement"))
    expect("footer.csv", "csv", ("", PLAIN), notes=["1 line left out that are no rows; the first is line 43"])
    half = rows(SERIES, ",")
    write("restarted.csv", lines(",".join(NAMES), half[:20], ",".join(NAMES), half[20:]))
    expect("restarted.csv", "csv", ("", PLAIN), notes=["1 line left out that are no rows; the first is line 22"])
    write("cut_line.csv", lines(",".join(NAMES), rows(SERIES, ","), "0.4")[:-1])
    expect("cut_line.csv", "csv", ("", PLAIN), notes=["the first is line 42"])


def times():
    def stamped(name, text, seconds, notes=()):
        write(name, lines("stamp;tau", [f"{a};{v}" for a, v in zip(text, TAU)]))
        expect(name, "csv", ("", [column("stamp", seconds, "s", True), column("tau", TAU)]), notes=notes)

    noon = 12 * 3600.0
    stamped("iso.csv", [f"2024-05-03T12:00:{t:06.3f}Z" for t in T], [noon + t for t in T])
    stamped("iso_blank.csv", [f"2024-05-03 12:00:{t:06.3f}".replace(".", ",") for t in T], [noon + t for t in T])
    stamped("german_date.csv", [f"03.05.2024 12:00:{t:06.3f}" for t in T], [noon + t for t in T])
    stamped("us_date.csv", [f"5/13/2024 12:00:{t:06.3f} PM" for t in T], [noon + t for t in T])
    late = [86399.8 + t for t in T]
    clock = [str((datetime.datetime(2024, 1, 1) + datetime.timedelta(seconds=round(s, 3))).time())[:12].ljust(12, "0") for s in late]
    stamped("midnight.csv", [c if "." in c else c[:8] + ".000" for c in clock], [round(s, 3) for s in late])
    serial = [45415.5 + i / 86400 for i in range(ROWS)]
    write("excel_serial.csv", lines("Datum;tau", [f"{s!r};{v!r}".replace(".", ",") for s, v in zip(serial, TAU)]))
    expect("excel_serial.csv", "csv", ("", [column("Datum", serial), column("tau", TAU)]))
    coarse = [i // 4 * 4 / 100 for i in range(ROWS)]
    write("coarse_clock.csv", lines("t,tau", [f"{t},{v}" for t, v in zip(coarse, TAU)]))
    expect("coarse_clock.csv", "csv", ("", [column("t", coarse), column("tau", TAU)]))


def refused():
    refuse("ambiguous.csv", "may be the decimal mark or separate thousands", "--decimal")
    write("ambiguous.csv", lines("n;x", [f"{i};{'1,' if i % 2 else ''}{100 + i}" for i in range(ROWS)]))
    refuse("doubled_commas.csv", "columns are separated by commas, too")
    write("doubled_commas.csv", lines("t,tau", [f"{comma(a)},{comma(b)}" for a, b in zip(T[1:], TAU[1:])]))
    refuse("ragged.csv", "ragged.csv:4", "is no row of 3 cells")
    write("ragged.csv", lines(",".join(NAMES), [r + (",1" if i % 3 == 2 else "") for i, r in enumerate(rows(SERIES, ","))]))
    refuse("mixed_marks.csv", "mixed_marks.csv:32", "is no number with a decimal point")
    mixed = rows([T, TAU], ";")
    mixed[30] = "0.30;1,5"
    write("mixed_marks.csv", lines("t;tau", mixed))
    refuse("prose.txt", "no rows of numbers")
    write("prose.txt", "Dear colleague,\nthe gear was noisy today.\nNo data yet.\n")
    refuse("empty.csv", "is empty")
    write("empty.csv", "")
    refuse("noise.bin", "is of no form that is read")
    write("noise.bin", bytes((i * 73 + 11) % 256 for i in range(2000)))
    book = io.BytesIO()
    with zipfile.ZipFile(book, "w") as archive:
        archive.writestr(zipfile.ZipInfo("xl/workbook.xml"), "<workbook/>")
    refuse("workbook.xlsx", "Excel (.xlsx)", "CSV UTF-8")
    write("workbook.xlsx", book.getvalue())


def make():
    delimiters(), encodings(), numbers(), headers(), times(), refused()
    ugly()


def ugly():
    """Everything at once, as a bench of the nineties does it."""
    head = ["Messprotokoll", "Pr\u00fcfling: HFUC-20", "", "Kanal 1;Kanal 2;Kanal 3;", "Zeit;Motorwinkel;Drehmoment;",
            "ms;\u00b0;mNm;"]
    tau = [round(1000 * v, 1) for v in TAU]
    body = [f" {t};\"{comma(a)}\";{comma(b)};" for t, a, b in zip(T_MS, THETA, tau)]
    body[10] = f"{T_MS[10]};#NV;;"
    theta = [None if i == 10 else v for i, v in enumerate(THETA)]
    torque = [None if i == 10 else v for i, v in enumerate(tau)]
    write("ugly.csv", lines(head, body, end="\r\n"), "latin-1")
    expect("ugly.csv", "csv", ("", [column("Zeit", T_MS, "ms"), column("Motorwinkel", theta, "\u00b0"),
                                    column("Drehmoment", torque, "mNm"), column("column 4", [None] * ROWS)]),
           notes=["names on line 5, units on line 6"])
    labview()


def labview():
    """LabVIEW's measurement file: two heads, units on a labelled line, a comment behind each row."""
    head = ["LabVIEW Measurement\t", "Separator\tTab", "Date\t2024/03/05", "***End_of_Header***\t", "\t",
            "Channels\t2\t\t", f"Samples\t{ROWS}\t{ROWS}\t", "Date\t2024/03/05\t2024/03/05\t",
            "Y_Unit_Label\tdeg\tNm\t", "X_Dimension\tTime\tTime\t", "X0\t0.0E+0\t0.0E+0\t",
            "Delta_X\t0.01\t0.01\t", "***End_of_Header***\t\t\t", "X_Value\tMotor angle\tTorque\tComment"]
    write("scope.lvm", lines(head, [row + "\t" for row in rows(SERIES, "\t")], end="\r\n"))
    expect("scope.lvm", "csv", ("", [column("X_Value", T), column("Motor angle", THETA, "deg"),
                                     column("Torque", TAU, "Nm"), column("Comment", [None] * ROWS)]),
           notes=["names on line 14, units on line 9"])

def write(rows, interval):
    pass

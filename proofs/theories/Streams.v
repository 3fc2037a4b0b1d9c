(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Streams of enclosures: intersections [NEST-2], affine images [AFF-1], answers of programs [ORA-1], the polynomial
  that
   changes its sign where a given one does [ROOT-2], subsets alone being taken over [NEST-1], ends on a grid [ENC-2]. *)
From Coq Require Import Reals Lra Lia Psatz List.
Open Scope R_scope.

(* ---- intersections ---- *)

Definition interval : Type := (R * R)%type.
Definition holds (E : interval) (v : R) : Prop := fst E <= v <= snd E.
Definition meet (E G : interval) : interval := (Rmax (fst E) (fst G), Rmin (snd E) (snd G)).
(* What the stream holds after the calls 0 .. n. *)
Fixpoint so_far (E : nat -> interval) (n : nat) : interval :=
  match n with O => E O | S m => meet (so_far E m) (E (S m)) end.

Lemma meet_exact E G v : holds (meet E G) v <-> holds E v /\ holds G v.
Proof.
  unfold holds, meet. simpl. split.
  - intros [A D]. pose proof (Rmax_l (fst E) (fst G)). pose proof (Rmax_r (fst E) (fst G)).
    pose proof (Rmin_l (snd E) (snd G)). pose proof (Rmin_r (snd E) (snd G)). lra.
  - intros [[A D] [F H]]. split; [now apply Rmax_lub | now apply Rmin_glb].
Qed.

(* It is the intersection of all enclosures: every value that all hold, it holds; it lies in each, and shrinks. *)
Theorem intersection_exact E n v : holds (so_far E n) v <-> forall m, (m <= n)%nat -> holds (E m) v.
Proof.
  induction n as [| n IH]; simpl.
  - split; [intros H m M; now replace m with O by lia | intros H; now apply H].
  - rewrite meet_exact, IH. split.
    + intros [H G] m M. destruct (Nat.eq_dec m (S n)) as [-> | D]; [exact G | apply H; lia].
    + intros H. split; [intros m M; apply H; lia | now apply H].
Qed.

Theorem intersection_nested E n v : holds (so_far E (S n)) v -> holds (so_far E n) v.
Proof. rewrite !intersection_exact. intros H m M. apply H. lia. Qed.

(* Empty, as its ends say, only where the enclosures are not of one value. *)
Theorem intersection_empty E n : snd (so_far E n) < fst (so_far E n) -> ~ exists v, forall m, (m <= n)%nat -> holds (E
  m) v.
Proof. intros L [v H]. apply intersection_exact in H. unfold holds in H. lra. Qed.

(* ---- affine images ---- *)

(* An end of a x over [x0,x1], by the sign of a. *)
Definition low (a x0 x1 : R) : R := if Rle_dec 0 a then a * x0 else a * x1.
Definition high (a x0 x1 : R) : R := if Rle_dec 0 a then a * x1 else a * x0.

Lemma scaled_image a x0 x1 u : x0 <= x1 -> (low a x0 x1 <= u <= high a x0 x1 <-> exists x, x0 <= x <= x1 /\ u = a * x).
Proof.
  intros X. unfold low, high. split.
  - intros H. destruct (Req_dec a 0) as [-> | A].
    + exists x0. destruct (Rle_dec 0 0); lra.
    + exists (u / a). split; [| field; exact A]. destruct (Rle_dec 0 a) as [P | P].
      * split; apply (Rmult_le_reg_l a); try lra; replace (a * (u / a)) with u by (field; exact A); lra.
      * split; apply (Rmult_le_reg_l (- a)); try lra; replace (- a * (u / a)) with (- u) by (field; exact A); lra.
  - intros [x [I ->]]. destruct (Rle_dec 0 a) as [P | P]; split; nra.
Qed.

Theorem affine_image a b c x0 x1 y0 y1 u : x0 <= x1 -> y0 <= y1 ->
  (low a x0 x1 + low b y0 y1 + c <= u <= high a x0 x1 + high b y0 y1 + c <->
   exists x y, x0 <= x <= x1 /\ y0 <= y <= y1 /\ u = a * x + b * y + c).
Proof.
  intros X Y. split.
  - intros H. set (w := u - c).
    assert (Ends : low b y0 y1 <= high b y0 y1) by (unfold low, high; destruct (Rle_dec 0 b); nra).
    set (s := Rmax (low a x0 x1) (w - high b y0 y1)).
    assert (S1 : low a x0 x1 <= s <= high a x0 x1).
    { unfold s. split; [apply Rmax_l | apply Rmax_lub; [unfold low, high; destruct (Rle_dec 0 a); nra | unfold w;
      lra]]. }
    assert (S2 : low b y0 y1 <= w - s <= high b y0 y1).
    { pose proof (Rmax_r (low a x0 x1) (w - high b y0 y1)) as R2. fold s in R2. split; [| lra].
      assert (s <= w - low b y0 y1); [| lra]. apply Rmax_lub; [unfold w |]; lra. }
    apply (scaled_image a x0 x1 s X) in S1. apply (scaled_image b y0 y1 (w - s) Y) in S2.
    destruct S1 as [x [Ix Ex]]. destruct S2 as [y [Iy Ey]]. exists x, y. split; [exact Ix |]. split; [exact Iy |].
    unfold w in Ey. lra.
  - intros [x [y [Ix [Iy ->]]]].
    assert (A : low a x0 x1 <= a * x <= high a x0 x1) by (apply scaled_image; [exact X | now exists x]).
    assert (B : low b y0 y1 <= b * y <= high b y0 y1) by (apply scaled_image; [exact Y | now exists y]). lra.
Qed.

(* Rounded outward to multiples of 2^-(bits+2), each end moves by less than one of them. *)
Theorem affine_width a b c x0 x1 y0 y1 lo hi (bits g : Z) : x0 <= x1 -> y0 <= y1 ->
  Rabs a + Rabs b <= powerRZ 2 g -> x1 - x0 <= powerRZ 2 (- (bits + 1 + g)) -> y1 - y0 <= powerRZ 2 (- (bits + 1 + g))
    ->
  low a x0 x1 + low b y0 y1 + c - lo < powerRZ 2 (- (bits + 2)) ->
  hi - (high a x0 x1 + high b y0 y1 + c) < powerRZ 2 (- (bits + 2)) -> hi - lo < powerRZ 2 (- bits).
Proof.
  intros X Y S Wx Wy L H. assert (T : 2 <> 0) by lra. assert (T1 : powerRZ 2 1 = 2) by (simpl; ring).
  assert (E1 : powerRZ 2 g * powerRZ 2 (- (bits + 1 + g)) = powerRZ 2 (- (bits + 1))).
  { rewrite <- powerRZ_add by exact T. f_equal. lia. }
  assert (E2 : powerRZ 2 (- bits) = 2 * powerRZ 2 (- (bits + 1))).
  { rewrite <- T1 at 2. rewrite <- powerRZ_add by exact T. f_equal. lia. }
  assert (E3 : powerRZ 2 (- (bits + 1)) = 2 * powerRZ 2 (- (bits + 2))).
  { rewrite <- T1 at 2. rewrite <- powerRZ_add by exact T. f_equal. lia. }
  set (d := powerRZ 2 (- (bits + 1 + g))) in *.
  assert (D : 0 < d) by (apply powerRZ_lt; lra).
  assert (A : high a x0 x1 - low a x0 x1 <= Rabs a * d).
  { unfold high, low, Rabs. destruct (Rle_dec 0 a); destruct (Rcase_abs a); nra. }
  assert (B : high b y0 y1 - low b y0 y1 <= Rabs b * d).
  { unfold high, low, Rabs. destruct (Rle_dec 0 b); destruct (Rcase_abs b); nra. }
  assert (K : (Rabs a + Rabs b) * d <= powerRZ 2 g * d) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* num < 2^n, den >= 2^(d-1). *)
Theorem affine_size num den (n d : Z) : 0 <= num < powerRZ 2 n -> powerRZ 2 (d - 1) <= den ->
  num / den < powerRZ 2 (n - d + 1).
Proof.
  intros [P Q] D. assert (E : powerRZ 2 (n - d + 1) * powerRZ 2 (d - 1) = powerRZ 2 n).
  { rewrite <- powerRZ_add by lra. f_equal. lia. }
  assert (0 < powerRZ 2 (d - 1)) by (apply powerRZ_lt; lra). assert (0 < powerRZ 2 (n - d + 1)) by (apply powerRZ_lt;
    lra).
  apply (Rmult_lt_reg_r den); [lra |]. replace (num / den * den) with num by (field; lra).
  assert (powerRZ 2 (n - d + 1) * powerRZ 2 (d - 1) <= powerRZ 2 (n - d + 1) * den) by (apply Rmult_le_compat_l;
    lra). lra.
Qed.

(* ---- answers ---- *)

(* A side [lo,hi] inside of that of K; J holds it, each end moved by less than 2^-64 of the length, or not at all. *)
Theorem answer_side K J lo hi : lo <= hi -> fst K <= lo -> hi <= snd K ->
  fst J <= lo -> hi <= snd J -> (lo - fst J < (hi - lo) / 2 ^ 64 \/ fst J = lo) -> (snd J - hi < (hi - lo) / 2 ^ 64 \/
    snd J = hi) ->
  (forall v, lo <= v <= hi -> holds (meet J K) v) /\ (forall v, holds (meet J K) v -> holds K v) /\
  (snd (meet J K) - fst (meet J K) = hi - lo \/ snd (meet J K) - fst (meet J K) - (hi - lo) < (hi - lo) / 2 ^ 63).
Proof.
  intros O K1 K2 J1 J2 M1 M2. split; [| split].
  - intros v V. apply meet_exact. unfold holds. lra.
  - intros v V. now apply meet_exact in V.
  - unfold meet. simpl fst. simpl snd. pose proof (Rmax_l (fst J) (fst K)). pose proof (Rmin_l (snd J) (snd K)).
    assert (Rmax (fst J) (fst K) <= lo) by (apply Rmax_lub; lra). assert (hi <= Rmin (snd J) (snd K)) by (apply
      Rmin_glb; lra).
    replace ((hi - lo) / 2 ^ 63) with ((hi - lo) / 2 ^ 64 + (hi - lo) / 2 ^ 64) by (simpl; field).
    assert (Q : 0 <= (hi - lo) / 2 ^ 64) by (apply Rmult_le_pos; [lra |]; left; apply Rinv_0_lt_compat, pow_lt; lra).
    destruct (Req_dec (Rmin (snd J) (snd K) - Rmax (fst J) (fst K)) (hi - lo)) as [E | E]; [now left | right].
    destruct M1 as [M1 | M1]; destruct M2 as [M2 | M2]; try lra.
Qed.

(* ---- odd parts ---- *)

(* The product of f_i^i, i from k on, of the f_i with odd i, and of f_i^(i/2). *)
Fixpoint powers (k : nat) (f : list R) : R := match f with nil => 1 | x :: l => x ^ k * powers (S k) l end.
Fixpoint odd_part (k : nat) (f : list R) : R :=
  match f with nil => 1 | x :: l => (if Nat.odd k then x else 1) * odd_part (S k) l end.
Fixpoint halves (k : nat) (f : list R) : R := match f with nil => 1 | x :: l => x ^ (Nat.div2 k) * halves (S k) l end.

Lemma odd_and_square k f : powers k f = odd_part k f * (halves k f * halves k f).
Proof.
  revert k. induction f as [| x l IH]; intros k; simpl; [ring |]. rewrite (IH (S k)).
  assert (E : x ^ k = (if Nat.odd k then x else 1) * (x ^ Nat.div2 k * x ^ Nat.div2 k)).
  { rewrite <- pow_add. pose proof (Nat.div2_odd k) as D. destruct (Nat.odd k); simpl Nat.b2n in D.
    - rewrite D at 1. replace (2 * Nat.div2 k + 1)%nat with (S (Nat.div2 k + Nat.div2 k)) by lia. reflexivity.
    - rewrite D at 1. replace (2 * Nat.div2 k + 0)%nat with (Nat.div2 k + Nat.div2 k)%nat by lia. ring. }
  rewrite E. ring.
Qed.

(* Where p is not 0, g has its sign, or everywhere the opposite one. *)
Theorem odd_part_signs c f l : c * powers 1 f <> 0 -> c * powers 1 l <> 0 ->
  (c * powers 1 f * (c * powers 1 l) < 0 <-> odd_part 1 f * odd_part 1 l < 0).
Proof.
  intros P Q. set (K := c * c * ((halves 1 f * halves 1 l) * (halves 1 f * halves 1 l))).
  assert (E : c * powers 1 f * (c * powers 1 l) = K * (odd_part 1 f * odd_part 1 l)).
  { rewrite (odd_and_square 1 f), (odd_and_square 1 l). unfold K. ring. }
  assert (N : K * (odd_part 1 f * odd_part 1 l) <> 0) by (rewrite <- E;
    now apply Rmult_integral_contrapositive_currified).
  assert (K0 : 0 < K).
  { assert (0 <= K) by (apply Rmult_le_pos; apply Rle_0_sqr). destruct (Req_dec K 0) as [Z | Z]; [| lra].
    exfalso. apply N. rewrite Z. ring. }
  rewrite E. split; intros H; nra.
Qed.

(* ---- only subsets are taken over ---- *)

(* A side: numerators of its ends over one denominator. The test compares cross products. *)
Record side : Type := Side { lower : R; upper : R; denominator : R }.
Definition of_side (a : side) : interval := (lower a / denominator a, upper a / denominator a).
Definition proper (a : side) : Prop := 0 < denominator a /\ lower a <= upper a.
Definition contains (a b : side) : Prop :=
  lower a * denominator b <= lower b * denominator a /\ upper b * denominator a <= upper a * denominator b.

Lemma quotient_le x y a b : 0 < a -> 0 < b -> (x / a <= y / b <-> x * b <= y * a).
Proof.
  intros A B. assert (E : x * b = x / a * (a * b)) by (field; lra). assert (F : y * a = y / b * (a * b)) by (field;
    lra).
  assert (P : 0 < a * b) by (apply Rmult_lt_0_compat; assumption). rewrite E, F. split; intros H.
  - apply Rmult_le_compat_r; lra.
  - now apply (Rmult_le_reg_r (a * b)).
Qed.

Theorem contains_exact a b : proper a -> proper b ->
  (contains a b <-> forall v, holds (of_side b) v -> holds (of_side a) v).
Proof.
  intros [A _] [B O]. unfold contains, holds, of_side. simpl.
  rewrite <- (quotient_le (lower a) (lower b)) by assumption. rewrite <- (quotient_le (upper b) (upper a)) by
    assumption.
  assert (Q : lower b / denominator b <= upper b / denominator b) by (apply quotient_le; try assumption;
    apply Rmult_le_compat_r; lra).
  split; [intros [H G] v V; lra |]. intros H.
  destruct (H (lower b / denominator b)) as [X _]; [lra |]. destruct (H (upper b / denominator b)) as [_ Y]; [lra |].
    now split.
Qed.

(* The rectangle held after one offer, a rectangle of two sides: the offer, if both sides pass; else the call fails. *)
Inductive offered (held : side * side) (offer : side * side) : side * side -> bool -> Prop :=
| offer_taken : contains (fst held) (fst offer) -> contains (snd held) (snd offer) -> offered held offer offer true
| offer_refused : ~ (contains (fst held) (fst offer) /\ contains (snd held) (snd offer)) -> offered held offer held
  false.
Inductive after (start : side * side) : list (side * side) -> side * side -> Prop :=
| after_none : after start nil start
| after_one l held offer next ok : after start l held -> offered held offer next ok -> after start (offer :: l) next.

Definition proper_rectangle (r : side * side) : Prop := proper (fst r) /\ proper (snd r).
Definition in_rectangle (r : side * side) (x y : R) : Prop := holds (of_side (fst r)) x /\ holds (of_side (snd r)) y.

(* An offer is taken over iff it is a subset; else the rectangle held before stays. *)
Theorem only_subsets held offer next ok : proper_rectangle held -> proper_rectangle offer -> offered held offer next
  ok ->
  (ok = true <-> forall x y, in_rectangle offer x y -> in_rectangle held x y) /\ next = (if ok then offer else held).
Proof.
  intros [Hx Hy] [Ox Oy] S.
  assert (Sub : (forall x y, in_rectangle offer x y -> in_rectangle held x y) <->
    contains (fst held) (fst offer) /\ contains (snd held) (snd offer)).
  { rewrite (contains_exact _ _ Hx Ox), (contains_exact _ _ Hy Oy). unfold in_rectangle. split;
    [| intros [F G] x y [X Y]; auto].
    assert (End : forall a, proper a -> holds (of_side a) (fst (of_side a))).
    { intros a [A O]. unfold holds, of_side. simpl. split; [lra |]. apply quotient_le; try assumption.
      apply Rmult_le_compat_r; lra. }
    intros F. split; intros v V; [apply (F v (fst (of_side (snd offer)))) | apply (F (fst (of_side (fst offer))) v)];
      auto. }
  rewrite Sub. destruct S; (split; [| reflexivity]); [tauto | split; [discriminate | contradiction]].
Qed.

(* So the rectangle held lies in the one held before, whatever is offered. *)
Theorem held_nested start l held : proper_rectangle start -> (forall o, In o l -> proper_rectangle o) -> after start l
  held ->
  proper_rectangle held /\ forall x y, in_rectangle held x y -> in_rectangle start x y.
Proof.
  intros P O S. induction S as [| l held offer next ok S IH Of]; [split; [exact P | auto] |].
  destruct (IH (fun o I => O o (or_intror I))) as [Ph Nest]. pose proof (O offer (or_introl eq_refl)) as Po.
  destruct (only_subsets held offer next ok Ph Po Of) as [Sub ->]. destruct ok; [| now split].
  split; [exact Po |]. intros x y X. apply Nest. now apply (proj1 Sub eq_refl).
Qed.

(* ---- ends on a grid ---- *)

(* Floor and ceiling on multiples of g hold all numbers between, and move each end by less than g. *)
Definition grid_floor (g x : R) : R := IZR (Int_part (x / g)) * g.
Definition grid_ceiling (g x : R) : R := - grid_floor g (- x).

Lemma grid_floor_below g x : 0 < g -> grid_floor g x <= x < grid_floor g x + g.
Proof.
  intros G. unfold grid_floor. destruct (base_Int_part (x / g)) as [L H]. assert (E : x = x / g * g) by (field; lra).
  set (n := IZR (Int_part (x / g))) in *. set (q := x / g) in *. split.
  - rewrite E. apply Rmult_le_compat_r; lra.
  - rewrite E at 1. assert (q * g < (n + 1) * g) by (apply Rmult_lt_compat_r; lra). lra.
Qed.

Theorem grid_holds g lo hi v : 0 < g -> lo <= v <= hi -> holds (grid_floor g lo, grid_ceiling g hi) v /\
  lo - g < grid_floor g lo /\ grid_ceiling g hi < hi + g.
Proof.
  intros G V. unfold holds, grid_ceiling. simpl. pose proof (grid_floor_below g lo G).
    pose proof (grid_floor_below g (- hi) G). lra.
Qed.

(* An end that is a multiple of g stays. *)
Theorem grid_keeps g (n : Z) : 0 < g -> grid_floor g (IZR n * g) = IZR n * g /\ grid_ceiling g (IZR n * g) = IZR n * g.
Proof.
  intros G. assert (K : forall m : Z, grid_floor g (IZR m * g) = IZR m * g).
  { intros m. unfold grid_floor. replace (IZR m * g / g) with (IZR m) by (field; lra).
    destruct (base_Int_part (IZR m)) as [L H]. set (k := Int_part (IZR m)) in *. apply le_IZR in L.
    assert (m - 1 < k)%Z by (apply lt_IZR; rewrite minus_IZR; lra). now replace k with m by lia. }
  split; [apply K |]. unfold grid_ceiling. replace (- (IZR n * g)) with (IZR (- n) * g) by (rewrite opp_IZR; ring).
  rewrite K, opp_IZR. ring.
Qed.

(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Tied faces [TIE-3]: a polygon of legal sides, whose true points are on one circle. No other site is in the disc, or
   on the circle; all pairs of its vertices are weakly Delaunay; pairs that are not sides never strictly. *)
From Coq Require Import Reals Lra Lia ZArith List Classical.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Path TiedRim Winding.
Open Scope R_scope.

(* From any side one comes to any other, side by side. *)
Definition one_cycle (E : list (nat * nat)) : Prop := forall P : nat -> nat -> Prop,
  (forall a b c, In (a, b) E -> In (b, c) E -> P a b -> P b c) ->
  forall a b c d, In (a, b) E -> In (c, d) E -> P a b -> P c d.

Definition reversed (E : list (nat * nat)) : list (nat * nat) := map (fun e => (snd e, fst e)) E.

Lemma total_reversed c E : total c (reversed E) = total (fun a b => c b a) E.
Proof. unfold total, reversed. induction E as [| e E IH]; simpl; [reflexivity | now rewrite IH]. Qed.

Section Polygon.
(* p: the representatives, of which the skeleton is; q: the true points. T: the triangles of the face; E: its rim. *)
Variables (N : nat) (B : sites) (p q : nat -> point) (T : list (nat * nat * nat)) (E : list (nat * nat)).
Definition on_rim (v : nat) : Prop := exists b, In (v, b) E \/ In (b, v) E.
Variable drawn : choice N B p.
Variable true_points : choice N B q.
Variable rim : rim_of T E.
Variable skeleton : forall a b c, In (a, b, c) T -> 0 < orient (p a) (p b) (p c) /\
  forall m, (m < N)%nat -> ~ on_rim m ->
    ~ (0 <= orient (p a) (p b) (p m) /\ 0 <= orient (p b) (p c) (p m) /\ 0 <= orient (p c) (p a) (p m)).
Variable side : forall a b, In (a, b) E -> (a < N)%nat /\ (b < N)%nat /\ a <> b /\ legal N B a b.
Variable corner : forall a b c, In (a, b) E -> In (b, c) E -> a <> c.
Variable cycle : one_cycle E.
Variables (o : point) (r : R).
Variable circle : forall v, on_rim v -> dist o (q v) = r.

(* ---- at all times of a motion from the representatives to the true points ---- *)

Definition along (v : nat) (t : R) : point := mix t (p v) (q v).

Lemma along_choice t : 0 <= t <= 1 -> choice N B (fun v => along v t).
Proof. intros S v V. apply inside_convex; [exact S | now apply drawn | now apply true_points]. Qed.

Lemma along_continuous v : continuity (fun t => fst (along v t)) /\ continuity (fun t => snd (along v t)).
Proof. unfold along, mix. simpl. split; reg. Qed.

Lemma off_side t a b m : 0 <= t <= 1 -> In (a, b) E -> (m < N)%nat -> m <> a -> m <> b ->
  ~ between (along m t) (along a t) (along b t).
Proof.
  intros S F M Da Db [s [Hs Q]]. destruct (side a b F) as [La [Lb [_ G]]].
  destruct (legal_sound N B a b _ La Lb G (along_choice t S)) as [w [Eq Out]].
  specialize (Out m M Da Db). simpl in Eq, Out.
  assert (dist w (along m t) <= dist w (along a t)); [| lra]. rewrite Q. apply disc_convex; [exact Hs | lra | lra].
Qed.

Lemma winds_not m : (m < N)%nat -> ~ on_rim m -> total (fun a b => passes (q m) (q a) (q b)) E = 0%Z.
Proof.
  intros M Nm.
  assert (W : total (fun a b => passes (along m 1) (along a 1) (along b 1)) E =
    total (fun a b => passes (along m 0) (along a 0) (along b 0)) E).
  { apply winding_steady; [now apply rim_closed with T | apply along_continuous | apply along_continuous |].
    intros t a b S F. apply off_side; auto; intros ->; apply Nm; [exists b; now left | exists a; now right]. }
  assert (One : forall v, along v 1 = q v) by (intros; apply mix_1).
  assert (Zero : forall v, along v 0 = p v) by (intros; apply mix_0).
  rewrite (total_same _ (fun a b => passes (q m) (q a) (q b))) in W by (intros; now rewrite !One).
  rewrite W, (total_same _ (fun a b => passes (p m) (p a) (p b))) by (intros; now rewrite !Zero).
  apply rim_around with T; [exact rim |]. intros a b c F. destruct (skeleton a b c F) as [D K].
  split; [exact D | now apply K].
Qed.

(* ---- the sides of the polygon of the true points ---- *)

Lemma goes_on a b : In (a, b) E -> exists c, In (b, c) E.
Proof.
  intros F. apply NNPP. intros No.
  assert (K : ((if Nat.eq_dec b b then 1 else 0) - (if Nat.eq_dec a b then 1 else 0) = 0)%Z).
  { apply (all_zero (fun x y => (if Nat.eq_dec y b then 1 else 0) - (if Nat.eq_dec x b then 1 else 0))%Z E);
    [| | exact F].
    - intros x y G. destruct (Nat.eq_dec x b) as [-> | _]; [exfalso; apply No; now exists y |].
      destruct (Nat.eq_dec y b); lia.
    - apply (rim_closed T E rim (fun v => if Nat.eq_dec v b then 1%Z else 0%Z)). }
  destruct (side a b F) as [_ [_ [D _]]]. destruct (Nat.eq_dec b b); [| contradiction].
  destruct (Nat.eq_dec a b); [contradiction | lia].
Qed.

Lemma comes_from a b : In (a, b) E -> exists c, In (c, a) E.
Proof.
  intros F. apply NNPP. intros No.
  assert (K : ((if Nat.eq_dec a a then 1 else 0) - (if Nat.eq_dec b a then 1 else 0))%Z = 0%Z).
  { apply (all_zero (fun x y => (if Nat.eq_dec x a then 1 else 0) - (if Nat.eq_dec y a then 1 else 0))%Z E);
    [| | exact F].
    - intros x y G. destruct (Nat.eq_dec y a) as [-> | _]; [exfalso; apply No; now exists x |].
      destruct (Nat.eq_dec x a); lia.
    - pose proof (rim_closed T E rim (fun v => if Nat.eq_dec v a then (-1)%Z else 0%Z)) as C. etransitivity;
        [| exact C].
      apply total_same. intros x y _. destruct (Nat.eq_dec x a), (Nat.eq_dec y a); reflexivity. }
  destruct (side a b F) as [_ [_ [D _]]]. destruct (Nat.eq_dec a a); [| contradiction].
  destruct (Nat.eq_dec b a) as [-> |]; [now elim D | lia].
Qed.

Lemma rim_below v : on_rim v -> (v < N)%nat.
Proof. intros [b [F | F]]; destruct (side _ _ F) as [A [C _]]; assumption. Qed.

Lemma true_disc a b : In (a, b) E -> exists w, about w (q a) (q b) = 0 /\
  forall k, (k < N)%nat -> k <> a -> k <> b -> 0 < about w (q a) (q k).
Proof.
  intros F. destruct (side a b F) as [La [Lb [_ G]]].
  destruct (legal_sound N B a b q La Lb G true_points) as [w [Eq Out]]. exists w. unfold about.
  split; [apply dist_eq in Eq; lra |]. intros k K Da Db. specialize (Out k K Da Db). apply dist_lt in Out. lra.
Qed.

Lemma apart_ends a b : In (a, b) E -> q a <> q b.
Proof.
  intros F Q. destruct (goes_on a b F) as [c G]. destruct (true_disc b c G) as [w [_ Out]].
  destruct (side a b F) as [La [_ [D _]]]. specialize (Out a La D (corner a b c F G)). rewrite Q in Out.
    unfold about in Out. lra.
Qed.

Lemma on_circle u v : on_rim u -> on_rim v -> about o (q u) (q v) = 0.
Proof. intros U V. unfold about. rewrite <- !dist_sq, !circle by assumption. ring. Qed.

(* All others that are not outside of the circle are on one side of each side. *)
Lemma one_side a b : In (a, b) E -> exists l, forall k, (k < N)%nat -> k <> a -> k <> b -> about o (q a) (q k) <= 0 ->
  0 < l * orient (q a) (q b) (q k).
Proof.
  intros F. destruct (true_disc a b F) as [w [Wb Out]].
  assert (Va : on_rim a) by (exists b; now left). assert (Vb : on_rim b) by (exists a; now right).
  destruct (pencil o w (q a) (q b) (apart_ends a b F) (on_circle a b Va Vb) Wb) as [l L]. exists l.
  intros k K Da Db I. specialize (Out k K Da Db). rewrite L in Out. lra.
Qed.

Definition leftward (a b : nat) : Prop := exists l, 0 < l /\
  forall k, (k < N)%nat -> k <> a -> k <> b -> about o (q a) (q k) <= 0 -> 0 < l * orient (q a) (q b) (q k).
Definition rightward (a b : nat) : Prop := exists l, l < 0 /\
  forall k, (k < N)%nat -> k <> a -> k <> b -> about o (q a) (q k) <= 0 -> 0 < l * orient (q a) (q b) (q k).

Lemma some_way a b : In (a, b) E -> leftward a b \/ rightward a b.
Proof.
  intros F. destruct (one_side a b F) as [l L]. destruct (goes_on a b F) as [c G].
  destruct (Rtotal_order l 0) as [O | [O | O]]; [right; now exists l | exfalso | left; exists l; now split].
  destruct (side b c G) as [_ [Lc [D _]]]. assert (Va : on_rim a) by (exists b; now left).
  assert (Vc : on_rim c) by (exists b; now right).
  specialize (L c Lc (not_eq_sym (corner a b c F G)) (not_eq_sym D)). rewrite (on_circle a c Va Vc), O in L. lra.
Qed.

Lemma one_way a b c : In (a, b) E -> In (b, c) E -> (leftward a b -> leftward b c) /\ (rightward a b -> rightward b c).
Proof.
  intros F G. pose proof (corner a b c F G) as D. destruct (side a b F) as [La [Lb [Dab _]]].
  destruct (side b c G) as [_ [Lc [Dbc _]]].
  assert (Va : on_rim a) by (exists b; now left). assert (Vb : on_rim b) by (exists a; now right).
  assert (Vc : on_rim c) by (exists b; now right).
  split; intros [l [O L]]; destruct (some_way b c G) as [[k [P K]] | [k [P K]]]; try (now exists k); exfalso;
    specialize (L c Lc (not_eq_sym D) (not_eq_sym Dbc)); rewrite (on_circle a c Va Vc) in L; specialize (L ltac:(lra));
    specialize (K a La Dab D); rewrite (on_circle b a Vb Va) in K; specialize (K ltac:(lra));
    replace (orient (q b) (q c) (q a)) with (orient (q a) (q b) (q c)) in K by (unfold orient; ring); nra.
Qed.

Lemma all_one_way : E = nil \/ (forall a b, In (a, b) E -> leftward a b) \/ (forall a b, In (a, b) E -> rightward a b).
Proof.
  destruct E as [| [x y] l] eqn:Es; [now left | right]. rewrite <- Es in *.
  assert (F : In (x, y) E) by (rewrite Es; now left).
  destruct (some_way x y F) as [W | W]; [left | right]; intros a b G;
    [apply (cycle leftward) with x y | apply (cycle rightward) with x y]; auto; intros u v w U V Q;
      now apply (one_way u v w).
Qed.

(* No other site is in the disc, or on the circle. *)
Theorem polygon_empty m : (exists v, on_rim v) -> (m < N)%nat -> ~ on_rim m -> r < dist o (q m).
Proof.
  intros [v V] M Nm. apply Rnot_le_lt. intros In_.
  assert (I : forall a, on_rim a -> about o (q a) (q m) <= 0).
  { intros a A. unfold about. rewrite <- !dist_sq, (circle a A). pose proof (dist_nonneg o (q m)).
    assert (dist o (q m) * dist o (q m) <= r * r) by (apply Rmult_le_compat; lra). lra. }
  assert (Off : forall a b, In (a, b) E -> m <> a /\ m <> b /\ on_rim a).
  { intros a b F. split; [| split]; [intros -> | intros -> | exists b; now left]; apply Nm;
      [exists b; now left | exists a; now right]. }
  pose proof (winds_not m M Nm) as W. pose proof (rim_closed T E rim) as C.
  assert (Some : E <> nil) by (intros X; destruct V as [b [F | F]]; rewrite X in F; destruct F).
  destruct all_one_way as [X | [X | X]]; [contradiction | |].
  - apply Some. apply (winds_around E q (q m) C); [| exact W]. intros a b F. destruct (X a b F) as [l [O L]].
    destruct (Off a b F) as [Da [Db A]]. specialize (L m M Da Db (I a A)). apply (Rmult_lt_reg_l l); lra.
  - apply Some. apply (map_eq_nil (fun e => (snd e, fst e)) E).
    apply (winds_around (reversed E) q (q m)).
    + intros g. rewrite total_reversed, (total_same _ (fun a b => (- (g b - g a))%Z)) by (intros; lia).
      rewrite (total_opposite (fun a b => (g b - g a)%Z)), C. reflexivity.
    + intros a b F. apply in_map_iff in F as [[x y] [Q F]]. simpl in Q. injection Q as <- <-.
      destruct (X x y F) as [l [O L]]. destruct (Off x y F) as [Da [Db A]]. specialize (L m M Da Db (I x A)).
      assert (orient (q x) (q y) (q m) < 0) by nra. unfold orient in *. lra.
    + rewrite total_reversed, (total_same _ (fun a b => (- passes (q m) (q a) (q b))%Z)) by (intros; apply passes_back).
      rewrite (total_opposite (fun a b => passes (q m) (q a) (q b))), W. reflexivity.
Qed.

(* All pairs of vertices are weakly Delaunay, ... *)
Theorem polygon_weak i j : on_rim i -> on_rim j -> 0 < r -> weak_edge N q i j.
Proof.
  intros I J R0. left. exists o, r. split; [exact R0 |]. split.
  - intros k _ [-> | ->]; now apply circle.
  - intros k K. destruct (classic (on_rim k)) as [V | V]; [rewrite (circle k V); lra |].
    left. apply polygon_empty; [now exists i | exact K | exact V].
Qed.

(* ... and never strictly, if they are not sides. *)
Theorem polygon_not_strict i j : on_rim i -> on_rim j -> i <> j -> ~ In (i, j) E -> ~ In (j, i) E ->
  ~ strict_edge N q i j.
Proof.
  intros I J D Nij Nji [w [Eq Out]].
  assert (Ways : exists x y, In (x, i) E /\ In (i, y) E).
  { destruct I as [b [F | F]]; [destruct (comes_from i b F) as [a G]; now exists a, b |
      destruct (goes_on b i F) as [c G]; now exists b, c]. }
  destruct Ways as [x [y [F G]]].
  assert (Vx : on_rim x) by (exists i; now left). assert (Vy : on_rim y) by (exists i; now right).
  assert (Dx : x <> j) by (intros ->; contradiction). assert (Dy : y <> j) by (intros ->; contradiction).
  destruct (side x i F) as [_ [_ [Dxi _]]]. destruct (side i y G) as [_ [_ [Diy _]]].
  assert (Apart : q i <> q j).
  { intros Q. destruct (true_disc x i F) as [u [Ub Uo]].
    specialize (Uo j (rim_below j J) (not_eq_sym Dx) (not_eq_sym D)). rewrite <- Q in Uo. lra. }
  assert (Wj : about w (q i) (q j) = 0) by (unfold about; apply dist_eq in Eq; lra).
  destruct (pencil o w (q i) (q j) Apart (on_circle i j I J) Wj) as [l L].
  assert (On : forall k, on_rim k -> k <> i -> k <> j -> 0 < l * orient (q i) (q j) (q k)).
  { intros k V Ki Kj. pose proof (Out k (rim_below k V) Ki Kj) as Q. apply dist_lt in Q.
    pose proof (L (q k)) as P. rewrite (on_circle i k I V) in P. unfold about in P. lra. }
  pose proof (On x Vx Dxi Dx) as Px. pose proof (On y Vy (not_eq_sym Diy) Dy) as Py.
  assert (Turn : forall a b, In (a, b) E -> j <> a -> j <> b ->
    (leftward a b -> 0 < orient (q a) (q b) (q j)) /\ (rightward a b -> orient (q a) (q b) (q j) < 0)).
  { intros a b H Ja Jb. assert (Va : on_rim a) by (exists b; now left).
    split; intros [k [O K]]; specialize (K j (rim_below j J) Ja Jb); rewrite (on_circle a j Va J) in K;
      specialize (K ltac:(lra)); nra. }
  destruct (Turn x i F (not_eq_sym Dx) (not_eq_sym D)) as [Lx Rx].
  destruct (Turn i y G (not_eq_sym D) (not_eq_sym Dy)) as [Ly Ry].
  replace (orient (q x) (q i) (q j)) with (orient (q i) (q j) (q x)) in * by (unfold orient; ring).
  replace (orient (q i) (q y) (q j)) with (- orient (q i) (q j) (q y)) in * by (unfold orient; ring).
  destruct (some_way x i F) as [W | W].
  - specialize (Lx W). specialize (Ly (proj1 (one_way x i y F G) W)). nra.
  - specialize (Rx W). specialize (Ry (proj2 (one_way x i y F G) W)). nra.
Qed.
End Polygon.
